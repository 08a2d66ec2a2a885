#include "device_disparities.hpp"

#include <span>
#include <vector>

#include "bits/parallel.hpp"
#include "gpu_renderer.hpp"
#include "render/block_disparity.hpp"

namespace hmlfc::gpu {
namespace {

uint32_t word_of(const BlockDisparity& told) {
  return static_cast<uint16_t>(told.disparity) | (told.confidence == 0 ? 0u : 1u << 16);
}

void read_map(const StreamView& stream, ViewPos view, std::span<uint32_t> words) {
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  for (size_t i = 0; i < words.size(); ++i) {
    const auto number = static_cast<uint32_t>(i);
    const auto told = walk_to_block_disparity(stream, view, number % plane.blocks_x,
                                              number / plane.blocks_x, nullptr);
    if (told) words[i] = word_of(*told);
  }
}

}  // namespace

Buffer upload_disparities(Device::State& device, const StreamView& stream) {
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  const size_t blocks = size_t{plane.blocks_x} * plane.blocks_y;
  const uint64_t views = stream.geometry.level(0).images();
  const uint64_t bytes = 4 * blocks * views;
  if (bytes > kMostDisparityBytes) {
    throw MachineError(FailureKind::kLimit,
                       "limit_exceeded: the disparities of all views take " +
                           std::to_string(bytes >> 20) + " MiB on the device, more than " +
                           std::to_string(kMostDisparityBytes >> 20) +
                           ": draw frames with geometry on the CPU (--backend cpu)");
  }
  std::vector<uint32_t> words(static_cast<size_t>(blocks * views));
  parallel_for(static_cast<size_t>(views), [&](size_t i) {
    const auto number = static_cast<uint32_t>(i);
    read_map(stream, {number / stream.header.cols, number % stream.header.cols},
             std::span(words).subspan(i * blocks, blocks));
  });
  Buffer buffer(device, bytes, Memory::kDevice);
  upload(device, bytes_of(words), buffer);
  return buffer;
}

}  // namespace hmlfc::gpu
