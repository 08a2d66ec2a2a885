#include "conform/view_assembly.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/dut.hpp>

#include "arithmetic/widths.hpp"
#include "decoder/colour_row.hpp"

namespace hmlfc::conform {
namespace {

DutAnswer<SamplePlane> assemble_plane(RunningDut& dut, const Decoder& golden, ViewPos view,
                                      Plane plane) {
  const auto [width, height] = golden.plane_size(plane);
  const uint32_t b = golden.header().block_size();
  const SampleRange range = sample_range(plane, golden.header().depth);  // STR-7
  SamplePlane samples(width, height);
  for (uint32_t y = 0; y < height; y += b) {
    for (uint32_t x = 0; x < width; x += b) {
      const auto block = dut.block({view, plane, x / b, y / b}, 0);
      if (!block) return tl::unexpected(block.error());
      for (uint32_t i = 0; i < b * b; ++i) {
        if (x + i % b >= width || y + i / b >= height) continue;
        const int32_t sample = (*block)[i];
        if (sample < range.lo || sample > range.hi) {
          return tl::unexpected(
              fmt::format("a sample of plane {} out of range", plane_name(plane)));
        }
        samples.row(y + i / b)[x + i % b] = static_cast<int16_t>(sample);
      }
    }
  }
  return samples;
}

}  // namespace

std::optional<std::string> wrong_geometry(const StreamHeader& header,
                                          const hmlfc_dut_geometry& geometry) {
  const hmlfc_dut_geometry right = dut_geometry(header);
  for (const auto& [name, value] : kGeometryFields) {
    if (geometry.*value == right.*value) continue;
    return fmt::format("{} {} instead of {}", name, geometry.*value, right.*value);
  }
  return std::nullopt;
}

DutAnswer<RgbImage> view_of(RunningDut& dut, bool by_block, const Decoder& golden, ViewPos view) {
  if (dut.can().views && !by_block) return dut.view(view);
  const StreamHeader& header = golden.header();
  std::array<SamplePlane, kPlaneCount> planes;
  for (const Plane plane : kPlanes) {
    auto samples = assemble_plane(dut, golden, view, plane);
    if (!samples) return tl::unexpected(samples.error());
    planes[static_cast<size_t>(plane)] = std::move(*samples);
  }
  return rgb_picture(planes, {0, 0, header.width, header.height},
                     header.chroma_format == ChromaFormat::k420, header.depth);
}

}  // namespace hmlfc::conform
