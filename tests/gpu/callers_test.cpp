#include "gpu/callers_test.hpp"

#include <hmlfc/gpu/recording.hpp>

#include "device_state.hpp"
#include "stimulus/random_stream.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::gpu {

std::vector<uint8_t> stream_of(uint32_t seed) {
  return seed % 2 == 0 ? tb::suite_stream(seed, 2u << seed % 3) : vectors::random_stream(seed, {});
}

std::vector<uint16_t> samples_of(std::span<const uint8_t> texels, const StreamHeader& header) {
  std::vector<uint16_t> samples;
  const size_t step = texel_bytes(header) / 4;
  for (size_t i = 0; i < texels.size(); i += step) {
    samples.push_back(static_cast<uint16_t>(texels[i] | (step == 2 ? texels[i + 1] << 8 : 0)));
  }
  return samples;
}

std::vector<uint16_t> texels_of(const Result<void>& drawn, const Frame& frame,
                                const FrameRecord& record, const StreamHeader& header) {
  const auto pixels =
      static_cast<size_t>(record.frame_width) * static_cast<size_t>(record.frame_height);
  std::vector<uint16_t> samples(4 * pixels);
  for (size_t i = 0; drawn && i < samples.size(); ++i) {
    samples[i] = static_cast<uint16_t>(i % 4 == 3 ? (1 << header.depth) - 1
                                                  : frame.image.samples[i / 4 * 3 + i % 4]);
  }
  return samples;
}

void run_alone(Device& device, const std::function<void(VkCommandBuffer)>& record) {
  Device::State& state = device.state();
  const vk::raii::CommandBuffers commands(
      *state.device,
      vk::CommandBufferAllocateInfo(**state.pool, vk::CommandBufferLevel::ePrimary, 1));
  const vk::CommandBuffer handle = *commands.front();
  commands.front().begin(vk::CommandBufferBeginInfo());
  record(handle);
  commands.front().end();
  state.queue->submit(vk::SubmitInfo({}, {}, handle));
  state.queue->waitIdle();
}

void CallersTest::SetUp() {
  GpuTest::SetUp();
  if (IsSkipped()) return;
  callers_.emplace(device().info().name, CallersOptions{.features12 = true});
  DeviceOptions options;
  options.check_barriers = true;
  shared_ = open_shared(options);
}

void CallersTest::TearDown() {
  if (!callers_) return;
  for (const std::string& message : callers_->messages()) ADD_FAILURE() << message;
}

std::optional<Device> CallersTest::open_shared(DeviceOptions options) {
  options.cache_folder = "";
  auto opened = open_device(callers_->handles(), options);
  if (opened) return *opened;
  ADD_FAILURE() << opened.error().message;
  return std::nullopt;
}

}  // namespace hmlfc::gpu
