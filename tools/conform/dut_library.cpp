#include "conform/dut_library.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

namespace hmlfc::conform {

io::IoResult<DutFunctions> load_dut_library(const std::filesystem::path& file) {
  // dlopen searches the system's folders for a name without a slash.
  void* library = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return io::file_error(file, fmt::format("cannot be loaded: {}", ::dlerror()));
  }
  const char* missing = nullptr;
  const auto find = [&]<class Function>(const char* name, Function& target, bool needed = true) {
    target = reinterpret_cast<Function>(::dlsym(library, name));
    if (target == nullptr && needed && missing == nullptr) missing = name;
  };
  DutFunctions f;
  find("hmlfc_dut_abi", f.abi);
  find("hmlfc_dut_name", f.name);
  find("hmlfc_dut_open", f.open);
  find("hmlfc_dut_get_geometry", f.get_geometry);
  find("hmlfc_dut_decode_view", f.decode_view);
  find("hmlfc_dut_decode_block", f.decode_block);
  find("hmlfc_dut_trace_block", f.trace_block, false);
  find("hmlfc_dut_frame_record", f.frame_record, false);
  find("hmlfc_dut_render_frame", f.render_frame, false);
  find("hmlfc_dut_trace_pixel", f.trace_pixel, false);
  find("hmlfc_dut_disparity_map", f.disparity_map, false);
  find("hmlfc_dut_error_name", f.error_name, false);
  find("hmlfc_dut_close", f.close);
  if (missing != nullptr) {
    return io::file_error(file, fmt::format("has no function {}; see hmlfc_dut.h", missing));
  }
  if (f.abi() != HMLFC_DUT_ABI) {
    return io::file_error(
        file, fmt::format("has version {} of hmlfc_dut.h, not {}; compile it again", f.abi(),
                          HMLFC_DUT_ABI));
  }
  return f;
}

}  // namespace hmlfc::conform
