#include "conform/dut_library.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

namespace hmlfc::conform {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& target) {
  target = reinterpret_cast<Function>(::dlsym(library, name));
  return target != nullptr;
}

// The name of a required function that is missing, or null.
const char* find_all(void* library, DutFunctions& f) {
  find(library, "hmlfc_dut_trace_block", f.trace_block);
  find(library, "hmlfc_dut_error_name", f.error_name);
  if (!find(library, "hmlfc_dut_abi", f.abi)) return "hmlfc_dut_abi";
  if (!find(library, "hmlfc_dut_name", f.name)) return "hmlfc_dut_name";
  if (!find(library, "hmlfc_dut_open", f.open)) return "hmlfc_dut_open";
  if (!find(library, "hmlfc_dut_get_geometry", f.get_geometry)) return "hmlfc_dut_get_geometry";
  if (!find(library, "hmlfc_dut_decode_view", f.decode_view)) return "hmlfc_dut_decode_view";
  if (!find(library, "hmlfc_dut_decode_block", f.decode_block)) return "hmlfc_dut_decode_block";
  if (!find(library, "hmlfc_dut_close", f.close)) return "hmlfc_dut_close";
  return nullptr;
}

}  // namespace

io::IoResult<DutFunctions> load_dut_library(const std::filesystem::path& file) {
  // dlopen searches the system's folders for a name without a slash.
  void* library = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return io::file_error(file, fmt::format("cannot be loaded: {}", ::dlerror()));
  }
  DutFunctions functions;
  if (const char* missing = find_all(library, functions)) {
    return io::file_error(file, fmt::format("has no function {}; see hmlfc_dut.h", missing));
  }
  if (functions.abi() != HMLFC_DUT_ABI) {
    return io::file_error(file,
                          fmt::format("has version {} of hmlfc_dut.h, not {}; compile it again",
                                      functions.abi(), HMLFC_DUT_ABI));
  }
  return functions;
}

}  // namespace hmlfc::conform
