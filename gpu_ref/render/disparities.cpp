#include "disparities.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "bits/parallel.hpp"
#include "decode/source_parts.hpp"
#include "render/block_disparity.hpp"

namespace hmlfc::gpu {
namespace {

// The map of one view, and 0 for a block that has an error (SRF-3).
void read_map(const StreamView& stream, ViewPos view, std::span<uint32_t> words) {
  const auto blocks = disparity_rows(stream, view, 0, stream.geometry.plane(Plane::kY).blocks_y);
  std::ranges::transform(blocks, words.begin(), [](const BlockDisparity& told) {
    return static_cast<uint16_t>(told.disparity) | (told.confidence == 0 ? 0u : 1u << 16);
  });
}

}  // namespace

Buffer upload_disparities(Device::State& device, const StreamView& stream) {
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  const size_t blocks = size_t{plane.blocks_x} * plane.blocks_y;
  const uint64_t views = stream.geometry.level(0).images();
  const uint64_t bytes = 4 * blocks * views;
  if (bytes > device.disparity_bytes) {
    throw MachineError(
        FailureKind::kLimit,
        "limit_exceeded: the disparities of all views take " + std::to_string(bytes >> 20) +
            " MiB on the device, more than " + std::to_string(device.disparity_bytes >> 20) +
            ": draw without geometry (--geometry plane) or on the CPU (--backend cpu)");
  }
  std::vector<uint32_t> words(static_cast<size_t>(blocks * views));
  for (uint32_t row = 0; row < stream.header.rows; ++row) {
    read_part(stream, [&](const StreamView& view) {
      parallel_for(stream.header.cols, [&](size_t col) {
        read_map(view, {row, static_cast<uint32_t>(col)},
                 std::span(words).subspan((row * stream.header.cols + col) * blocks, blocks));
      });
    });
  }
  Buffer buffer(device, bytes, Memory::kDevice);
  upload(device, bytes_of(words), buffer);
  return buffer;
}

}  // namespace hmlfc::gpu
