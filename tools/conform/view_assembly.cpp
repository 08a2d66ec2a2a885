#include "conform/view_assembly.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <hmlfc/dut.hpp>

#include "arithmetic/colour.hpp"

namespace hmlfc::conform {
namespace {

// Whether all samples lie in [lo, hi] (STR-7), those of the colour transform's proof.
bool in_range(const std::vector<int32_t>& samples, Plane plane, int depth) {
  const int32_t hi = (int32_t{1} << depth) - 1;
  const int32_t lo = plane == Plane::kY ? 0 : -hi;
  return std::ranges::all_of(samples, [&](int32_t v) { return v >= lo && v <= hi; });
}

DutAnswer<std::vector<int32_t>> assemble_plane(RunningDut& dut, const Decoder& golden, ViewPos view,
                                               Plane plane) {
  const auto [width, height] = golden.plane_size(plane);
  const uint32_t b = golden.header().block_size();
  std::vector<int32_t> samples(size_t{width} * height);
  for (uint32_t y = 0; y < height; y += b) {
    for (uint32_t x = 0; x < width; x += b) {
      const auto block = dut.block({view, plane, x / b, y / b}, 0);
      if (!block) return tl::unexpected(block.error());
      for (uint32_t row = 0; row < std::min(b, height - y); ++row) {
        std::copy_n(block->begin() + row * b, std::min(b, width - x),
                    samples.begin() + static_cast<ptrdiff_t>(size_t{y + row} * width + x));
      }
    }
  }
  if (!in_range(samples, plane, golden.header().depth)) {
    return tl::unexpected(fmt::format("a sample of plane {} out of range", plane_name(plane)));
  }
  return samples;
}

}  // namespace

std::optional<std::string> wrong_geometry(const StreamHeader& header,
                                          const hmlfc_dut_geometry& geometry) {
  const hmlfc_dut_geometry right = dut_geometry(header);
  struct Field {
    const char* name;
    uint32_t hmlfc_dut_geometry::*value;
  };
  constexpr Field kFields[] = {{"rows", &hmlfc_dut_geometry::rows},
                               {"cols", &hmlfc_dut_geometry::cols},
                               {"width", &hmlfc_dut_geometry::width},
                               {"height", &hmlfc_dut_geometry::height},
                               {"depth", &hmlfc_dut_geometry::depth},
                               {"chroma_format", &hmlfc_dut_geometry::chroma_format},
                               {"block_log2", &hmlfc_dut_geometry::block_log2},
                               {"tree_height", &hmlfc_dut_geometry::tree_height}};
  for (const auto& [name, value] : kFields) {
    if (geometry.*value == right.*value) continue;
    return fmt::format("{} {} instead of {}", name, geometry.*value, right.*value);
  }
  return std::nullopt;
}

DutAnswer<RgbImage> view_of(RunningDut& dut, bool by_block, const Decoder& golden, ViewPos view) {
  if (dut.can().views && !by_block) return dut.view(view);
  const StreamHeader& header = golden.header();
  std::array<std::vector<int32_t>, kPlaneCount> planes;
  for (const Plane plane : kPlanes) {
    auto samples = assemble_plane(dut, golden, view, plane);
    if (!samples) return tl::unexpected(samples.error());
    planes[static_cast<size_t>(plane)] = std::move(*samples);
  }
  const unsigned shift = header.chroma_format == ChromaFormat::k420 ? 1 : 0;
  const uint32_t chroma_width = golden.plane_size(Plane::kCo).width;
  RgbImage image{header.width, header.height, header.depth, {}};
  image.samples.reserve(size_t{header.width} * header.height * 3);
  for (uint32_t y = 0; y < header.height; ++y) {
    for (uint32_t x = 0; x < header.width; ++x) {
      const size_t at = size_t{y >> shift} * chroma_width + (x >> shift);
      const Rgb pixel = inverse_colour(
          {planes[0][size_t{y} * header.width + x], planes[1][at], planes[2][at]}, header.depth);
      for (const int32_t value : {pixel.r, pixel.g, pixel.b}) {
        image.samples.push_back(static_cast<uint16_t>(value));
      }
    }
  }
  return image;
}

}  // namespace hmlfc::conform
