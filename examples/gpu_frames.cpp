// Draws frames of a camera that moves across the views, three under way at once, on a Vulkan device
// that this program has opened. A timeline semaphore says which are done.
//   gpu_frames FILE FRAMES FOLDER      writes 0.ppm, 1.ppm, ...; exit status 3: no Vulkan device
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/recording.hpp>
#include <hmlfc/gpu/renderer.hpp>

#include "vulkan_program.hpp"

namespace {

using Property = vk::MemoryPropertyFlagBits;

constexpr uint64_t kUnderWay = 3;
constexpr uint64_t kCacheBytes = uint64_t{64} << 20;

// Frame `i` of `frames`: between the first view and the last.
hmlfc::FrameRecord frame_of_path(const hmlfc::StreamHeader& header, uint64_t i, uint64_t frames) {
  const double part = frames < 2 ? 0 : static_cast<double>(i) / static_cast<double>(frames - 1);
  hmlfc::Camera camera;
  camera.position = {part * (header.cols - 1), part * (header.rows - 1), 0};
  camera.geometry = suitable_geometry(header);
  const auto record = frame_record(camera, header);
  if (!record) throw std::runtime_error(record.error().message);
  return *record;
}

// What one of the frames under way has for itself: the host sees its picture.
struct Slot {
  Slot(const Vulkan& vulkan, uint64_t bytes)
      : picture(*vulkan.device, {{}, bytes, vk::BufferUsageFlagBits::eTransferDst}),
        memory(vulkan.allocate(picture, Property::eHostVisible | Property::eHostCoherent)),
        texels(static_cast<const uint8_t*>(memory.mapMemory(0, bytes))),
        pool(*vulkan.device, {{}, vulkan.family}),
        commands(*vulkan.device, {*pool, vk::CommandBufferLevel::ePrimary, 1}) {}

  vk::raii::Buffer picture;
  vk::raii::DeviceMemory memory;
  const uint8_t* texels;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffers commands;
  gpu::FrameRecording recording;
  uint64_t submission = 0;  // of its last frame: the semaphore's value when that is done
};

class Frames {
 public:
  Frames(const Vulkan& vulkan, gpu::GpuRenderer& renderer, uint64_t bytes)
      : vulkan_(vulkan),
        renderer_(renderer),
        slots_{Slot(vulkan, bytes), Slot(vulkan, bytes), Slot(vulkan, bytes)},
        done_(*vulkan.device, vk::SemaphoreCreateInfo({}, &kTimeline)) {}
  ~Frames() { vulkan_.queue->waitIdle(); }

  // Submits frame number `i`; waits until frame i - 3, which has the same slot, is done.
  void draw(uint64_t i, const hmlfc::FrameRecord& frame) {
    Slot& slot = slots_[i % kUnderWay];
    wait(slot.submission);
    slot.pool.reset();
    const vk::raii::CommandBuffer& commands = slot.commands.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    value_of(record(renderer_, *commands, frame, 0, gpu::BufferTarget{*slot.picture, 0},
                    slot.recording));
    const vk::MemoryBarrier host(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost,
                             {}, host, {}, {});
    commands.end();
    slot.submission = ++submitted_;
    const vk::TimelineSemaphoreSubmitInfo value(0, nullptr, 1, &slot.submission);
    const vk::CommandBuffer handle = *commands;
    vulkan_.queue->submit(vk::SubmitInfo(0, nullptr, nullptr, 1, &handle, 1, &*done_, &value));
  }

  // The texels of frame number `i`, one of the last three.
  const uint8_t* finish(uint64_t i, const hmlfc::FrameRecord& frame) {
    const Slot& slot = slots_[i % kUnderWay];
    wait(slot.submission);
    if (!slot.recording.result().had_room) {
      vulkan_.queue->waitIdle();
      value_of(renderer_.render(frame, 0));  // makes room
      draw(i, frame);
      wait(slot.submission);
    }
    const hmlfc::ErrorCode status = slot.recording.result().status;
    if (status != hmlfc::ErrorCode::kOk) throw std::runtime_error(error_meaning(status).data());
    return slot.texels;
  }

 private:
  void wait(uint64_t submission) const {
    if (vulkan_.device->waitSemaphores({{}, *done_, submission}, UINT64_MAX) !=
        vk::Result::eSuccess) {
      throw std::runtime_error("the device does not answer");
    }
  }

  inline static const vk::SemaphoreTypeCreateInfo kTimeline{vk::SemaphoreType::eTimeline, 0};
  const Vulkan& vulkan_;
  gpu::GpuRenderer& renderer_;
  std::array<Slot, kUnderWay> slots_;
  vk::raii::Semaphore done_;
  uint64_t submitted_ = 0;
};

void draw_path(const hmlfc::Decoder& stream, uint64_t frames, const std::string& folder) {
  const hmlfc::StreamHeader& header = stream.header();
  const Vulkan vulkan;
  gpu::Device device = *vulkan.decoder_device;  // the same device
  auto renderer = value_of(gpu::GpuRenderer::open(device, stream, kCacheBytes));
  const VkExtent2D size{header.width, header.height};
  Frames ring(vulkan, renderer, uint64_t{size.width} * size.height * gpu::texel_bytes(header));
  for (uint64_t i = 0; i < frames + kUnderWay; ++i) {
    if (i >= kUnderWay) {
      const uint64_t done = i - kUnderWay;
      write_ppm(folder + "/" + std::to_string(done) + ".ppm", size, header,
                ring.finish(done, frame_of_path(header, done, frames)));
    }
    if (i < frames) ring.draw(i, frame_of_path(header, i, frames));
  }
}

}  // namespace

int main(int count, char** arguments) {
  const int frames = count == 4 ? std::atoi(arguments[2]) : 0;
  if (frames < static_cast<int>(kUnderWay)) {
    std::fprintf(stderr, "usage: gpu_frames FILE FRAMES FOLDER, FRAMES at least 3\n");
    return 2;
  }
  return run_on_stream(arguments[1], [&](const hmlfc::Decoder& stream) {
    draw_path(stream, static_cast<uint64_t>(frames), arguments[3]);
  });
}
