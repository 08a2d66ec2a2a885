// Decodes a view tile by tile into a texture, on a Vulkan device that this program has opened, and
// copies the texture to a picture. A timeline semaphore orders the two submissions.
//   gpu_tiles FILE ROW COL PICTURE.ppm      exit status 3: no Vulkan device
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/recording.hpp>

#include "vulkan_program.hpp"

namespace {

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;
using Texture = vk::raii::Image;

// A texture turns from one layout to another, between transfers.
void turn(const vk::raii::CommandBuffer& commands, const Texture& texture, Layout from, Layout to) {
  const vk::ImageMemoryBarrier barrier(Access::eTransferWrite,
                                       Access::eTransferRead | Access::eTransferWrite, from, to,
                                       VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *texture,
                                       {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
  commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, barrier);
}

constexpr uint32_t kTile = 16;  // blocks

// Records the tiles of a view, each at its place in the texture.
gpu::Recording record_tiles(const gpu::GpuDecoder& decoder, const hmlfc::StreamHeader& header,
                            hmlfc::ViewPos view, const vk::raii::CommandBuffer& commands,
                            const Texture& texture) {
  const uint32_t side = header.block_size();
  const uint32_t columns = (header.width + side - 1) / side;
  const uint32_t rows = (header.height + side - 1) / side;
  std::vector<gpu::PixelArea> tiles;
  std::vector<gpu::TexelPlace> places;
  for (uint32_t by = 0; by < rows; by += kTile) {
    for (uint32_t bx = 0; bx < columns; bx += kTile) {
      tiles.push_back({view, bx, by, std::min(kTile, columns - bx), std::min(kTile, rows - by), 0});
      places.push_back({bx * side, by * side, 0});
    }
  }
  return value_of(
      record(decoder, *commands, tiles, gpu::ImageTarget{.image = *texture, .places = places}));
}

// Submits both, the second for when the first is done, and waits.
void run(const Vulkan& vulkan, const vk::raii::CommandBuffers& commands) {
  const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
  const vk::raii::Semaphore done(*vulkan.device, vk::SemaphoreCreateInfo({}, &timeline));
  const uint64_t steps[] = {1, 2};  // decoded, copied
  const vk::PipelineStageFlags waiting = Stage::eTransfer;
  const vk::TimelineSemaphoreSubmitInfo first(0, nullptr, 1, &steps[0]);
  const vk::TimelineSemaphoreSubmitInfo second(1, &steps[0], 1, &steps[1]);
  vulkan.queue->submit({vk::SubmitInfo(0, nullptr, nullptr, 1, &*commands[0], 1, &*done, &first),
                        vk::SubmitInfo(1, &*done, &waiting, 1, &*commands[1], 1, &*done, &second)});
  if (vulkan.device->waitSemaphores({{}, *done, steps[1]}, UINT64_MAX) != vk::Result::eSuccess) {
    throw std::runtime_error("the device does not answer");
  }
}

void decode(const Vulkan& vulkan, const hmlfc::Decoder& stream, hmlfc::ViewPos view,
            const char* path) {
  const hmlfc::StreamHeader& header = stream.header();
  gpu::Device decoder_device = *vulkan.decoder_device;  // the same device
  const auto decoder = value_of(gpu::GpuDecoder::open(decoder_device, stream));
  const vk::raii::Device& device = *vulkan.device;
  using Usage = vk::ImageUsageFlagBits;
  const vk::Extent3D extent(header.width, header.height, 1);
  const auto format =
      header.depth == 8 ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR16G16B16A16Uint;
  Texture texture(
      device,
      vk::ImageCreateInfo({}, vk::ImageType::e2D, format, extent, 1, 1, vk::SampleCountFlagBits::e1,
                          vk::ImageTiling::eOptimal, Usage::eTransferDst | Usage::eTransferSrc));
  const auto texture_memory = vulkan.allocate(texture, {});
  const vk::DeviceSize bytes =
      vk::DeviceSize{header.width} * header.height * gpu::texel_bytes(header);
  vk::raii::Buffer picture(device, {{}, bytes, vk::BufferUsageFlagBits::eTransferDst});
  using Property = vk::MemoryPropertyFlagBits;
  const auto memory = vulkan.allocate(picture, Property::eHostVisible | Property::eHostCoherent);

  const vk::raii::CommandPool pool(device, {{}, vulkan.family});
  const vk::raii::CommandBuffers commands(device, {*pool, vk::CommandBufferLevel::ePrimary, 2});
  commands[0].begin(vk::CommandBufferBeginInfo());
  turn(commands[0], texture, Layout::eUndefined, Layout::eTransferDstOptimal);
  const auto recording = record_tiles(decoder, header, view, commands[0], texture);
  commands[0].end();
  commands[1].begin(vk::CommandBufferBeginInfo());
  turn(commands[1], texture, Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal);
  commands[1].copyImageToBuffer(
      *texture, Layout::eTransferSrcOptimal, *picture,
      vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, extent));
  commands[1].pipelineBarrier(Stage::eTransfer, Stage::eHost, {},
                              vk::MemoryBarrier(Access::eTransferWrite, Access::eHostRead), {}, {});
  commands[1].end();

  run(vulkan, commands);
  for (const uint8_t status : recording.statuses()) {
    if (status != 0) throw std::runtime_error(error_meaning(hmlfc::ErrorCode{status}).data());
  }
  write_ppm(path, {header.width, header.height}, header,
            static_cast<const uint8_t*>(memory.mapMemory(0, bytes)));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) {
    std::fprintf(stderr, "usage: gpu_tiles FILE ROW COL PICTURE.ppm\n");
    return 2;
  }
  return run_on_stream(arguments[1], [&](const hmlfc::Decoder& stream) {
    const Vulkan vulkan;
    const auto row = static_cast<uint32_t>(std::atoi(arguments[2]));
    const auto col = static_cast<uint32_t>(std::atoi(arguments[3]));
    decode(vulkan, stream, {row, col}, arguments[4]);
  });
}
