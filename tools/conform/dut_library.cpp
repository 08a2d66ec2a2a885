#include "conform/dut_library.hpp"

#include <dlfcn.h>

#include <algorithm>

#include <fmt/format.h>

#include "arithmetic/colour.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint16_t kNotWritten = 0xFFFF;  // no sample has 16 bits

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

bool plausible(const hmlfc_dut_geometry& g) {
  const auto within = [](uint32_t value, uint32_t lo, uint32_t hi) {
    return value >= lo && value <= hi;
  };
  return within(g.rows, 1, 4096) && within(g.cols, 1, 4096) && within(g.width, 1, 65536) &&
         within(g.height, 1, 65536) && within(g.depth, 8, 12) && g.chroma_format <= 1 &&
         within(g.block_log2, 1, 3) && g.tree_height <= 15;
}

std::string text(ViewPos view) { return fmt::format("view {},{}", view.row, view.col); }

uint32_t halved(uint32_t side) { return (side + 1) / 2; }

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

DutError LibraryDecoder::error(int status, std::string where) const {
  if (status == HMLFC_DUT_CANNOT_RUN) return {"cannot run here", std::move(where), true};
  if (functions_.error_name != nullptr) {
    if (const char* name = functions_.error_name(status)) return {name, std::move(where)};
  }
  const bool known = status > 0 && status < kErrorCodeCount;
  return {known ? std::string(error_name(static_cast<ErrorCode>(status)))
                : fmt::format("status {}", status),
          std::move(where)};
}

DutResult<LibraryDecoder> LibraryDecoder::open(const DutFunctions& functions,
                                               std::span<const uint8_t> file) {
  hmlfc_dut* raw = nullptr;
  const int status = functions.open(file.data(), file.size(), &raw);
  LibraryDecoder decoder(functions, Handle(raw, functions.close));
  if (status != 0) return tl::unexpected(decoder.error(status, "open"));
  const int failed = functions.get_geometry(raw, &decoder.geometry_);
  if (failed != 0) return tl::unexpected(decoder.error(failed, "get_geometry"));
  if (!plausible(decoder.geometry_)) {
    return tl::unexpected(DutError{"a field outside its interval", "get_geometry"});
  }
  return decoder;
}

DutResult<RgbImage> LibraryDecoder::decode_view(ViewPos view) const {
  RgbImage image{geometry_.width, geometry_.height, static_cast<int>(geometry_.depth), {}};
  image.samples.assign(size_t{image.width} * image.height * 3, kNotWritten);
  const int status =
      functions_.decode_view(handle_.get(), view.row, view.col, image.samples.data());
  if (status != 0) return tl::unexpected(error(status, text(view)));
  return image;
}

DutResult<std::vector<int32_t>> LibraryDecoder::decode_plane(ViewPos view, Plane plane,
                                                             uint32_t width,
                                                             uint32_t height) const {
  const uint32_t b = 1u << geometry_.block_log2;
  std::vector<int32_t> samples(size_t{width} * height);
  for (uint32_t y = 0; y < height; y += b) {
    for (uint32_t x = 0; x < width; x += b) {
      int32_t block[HMLFC_DUT_BLOCK_SAMPLES] = {};
      const int status = functions_.decode_block(
          handle_.get(), view.row, view.col, static_cast<uint32_t>(plane), x / b, y / b, 0, block);
      if (status != 0) {
        return tl::unexpected(error(status, fmt::format("{} plane {} block {},{}", text(view),
                                                        plane_name(plane), x / b, y / b)));
      }
      for (uint32_t row = 0; row < std::min(b, height - y); ++row) {
        std::copy_n(block + row * b, std::min(b, width - x),
                    samples.begin() + static_cast<ptrdiff_t>(size_t{y + row} * width + x));
      }
    }
  }
  return samples;
}

DutResult<RgbImage> LibraryDecoder::decode_view_by_block(ViewPos view) const {
  const auto& [rows, cols, width, height, depth, chroma, log2, tree] = geometry_;
  const unsigned shift = chroma == 0 ? 1 : 0;
  const uint32_t chroma_width = shift == 1 ? halved(width) : width;
  const uint32_t chroma_height = shift == 1 ? halved(height) : height;
  const auto luma = decode_plane(view, Plane::kY, width, height);
  if (!luma) return tl::unexpected(luma.error());
  const auto co = decode_plane(view, Plane::kCo, chroma_width, chroma_height);
  if (!co) return tl::unexpected(co.error());
  const auto cg = decode_plane(view, Plane::kCg, chroma_width, chroma_height);
  if (!cg) return tl::unexpected(cg.error());
  RgbImage image{width, height, static_cast<int>(depth), {}};
  image.samples.reserve(size_t{width} * height * 3);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const size_t at = size_t{y >> shift} * chroma_width + (x >> shift);
      const Rgb pixel =
          inverse_colour({(*luma)[size_t{y} * width + x], (*co)[at], (*cg)[at]}, image.depth);
      for (const int32_t value : {pixel.r, pixel.g, pixel.b}) {
        image.samples.push_back(static_cast<uint16_t>(value));
      }
    }
  }
  return image;
}

DutResult<void> LibraryDecoder::trace(const BlockAddress& block, hmlfc_dut_stage_sink sink,
                                      void* context) const {
  if (functions_.trace_block == nullptr) {
    return tl::unexpected(DutError{"no function hmlfc_dut_trace_block", "trace"});
  }
  const int status =
      functions_.trace_block(handle_.get(), block.view.row, block.view.col,
                             static_cast<uint32_t>(block.plane), block.bx, block.by, sink, context);
  if (status != 0) return tl::unexpected(error(status, text(block.view)));
  return {};
}

}  // namespace hmlfc::conform
