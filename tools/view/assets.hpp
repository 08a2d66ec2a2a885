// The files of the page, which are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace hmlfc::view {

/// One file.
struct Asset {
  std::string_view name;  ///< "look.js"
  std::string_view type;  ///< "application/javascript; charset=utf-8"
  std::string_view content;
};

/// All files of tools/view/page/, and the specification. Made by cmake/EmbedFiles.cmake.
std::span<const Asset> assets();

/// The file of this name, or null.
const Asset* find_asset(std::string_view name);

}  // namespace hmlfc::view
