# cmake -DOUTPUT=FILE.cpp -DFILES=FILE;... -P EmbedFiles.cmake: the files as assets of tools/view/assets.hpp.

set(types html "text/html" css "text/css" js "application/javascript" md "application/markdown")
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  cmake_path(GET file FILENAME name)
  cmake_path(GET file EXTENSION LAST_ONLY extension)
  string(SUBSTRING "${extension}" 1 -1 extension)
  list(FIND types "${extension}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${file}: no media type for .${extension}")
  endif()
  math(EXPR at "${at} + 1")
  list(GET types ${at} type)
  file(READ "${file}" bytes HEX)
  if(extension STREQUAL "html")
    file(READ "${file}" page)
    cmake_path(GET file PARENT_PATH folder)
    file(READ "${folder}/look.html" look)
    string(REPLACE "{{look}}" "${look}" page "${page}")
    string(HEX "${page}" bytes)
  endif()
  string(LENGTH "${bytes}" size)
  math(EXPR size "${size} / 2")
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(................................................................................)"
    "\\1\n" bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char kFile${number}[] = {\n${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", \"${type}; charset=utf-8\", text(kFile${number}, ${size})},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[// Made by cmake/EmbedFiles.cmake.
#include "view/assets.hpp"

#include <algorithm>
#include <cstddef>

namespace hmlfc::view {
namespace {

@arrays@
std::string_view text(const unsigned char* bytes, size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::span<const Asset> assets() {
  static const Asset kAssets[] = {
@rows@  };
  return kAssets;
}

const Asset* find_asset(std::string_view name) {
  const auto all = assets();
  const auto found = std::ranges::find(all, name, &Asset::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace hmlfc::view
]])
