#include "gpu/program.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "stimulus/random_stream.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::gpu {
namespace {

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

vk::raii::CommandBuffers allocate_commands(const Device::State& device, uint32_t count) {
  return {*device.device,
          vk::CommandBufferAllocateInfo(**device.pool, vk::CommandBufferLevel::ePrimary, count)};
}

// Makes what transfers wrote visible to the host.
void end(const vk::raii::CommandBuffer& commands) {
  const vk::MemoryBarrier host(Access::eTransferWrite, Access::eHostRead);
  commands.pipelineBarrier(Stage::eTransfer, Stage::eHost, {}, host, {}, {});
  commands.end();
}

vk::raii::Fence signalled_fence(const Device::State& device) {
  return {*device.device, vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)};
}

vk::raii::DeviceMemory memory_of(const Device::State& device, const vk::raii::Image& image) {
  const vk::MemoryRequirements needs = image.getMemoryRequirements();
  const auto type = static_cast<uint32_t>(std::countr_zero(needs.memoryTypeBits));
  return {*device.device, vk::MemoryAllocateInfo(needs.size, type)};
}

constexpr vk::ImageSubresourceRange kBothLayers(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 2);

vk::ImageMemoryBarrier image_barrier(vk::Image image, Access before, Access after, Layout from,
                                     Layout to) {
  return {before, after,      from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
          image,  kBothLayers};
}

}  // namespace

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

void ProgramTest::SetUp() {
  GpuTest::SetUp();
  if (!IsSkipped()) program_ = open_validated();
}

void ProgramTest::TearDown() {
  if (!program_) return;
  for (const std::string& message : program_->validation_messages()) ADD_FAILURE() << message;
}

ProgramCommands::ProgramCommands(Device& device, const Record& record)
    : device_(&device.state()), commands_(std::move(allocate_commands(*device_, 1).front())) {
  commands_.begin(vk::CommandBufferBeginInfo());
  record(commands_);
  end(commands_);
}

void ProgramCommands::run() const {
  const vk::CommandBuffer commands = *commands_;
  device_->queue->submit(vk::SubmitInfo({}, {}, commands));
  device_->queue->waitIdle();
}

ProgramImage::ProgramImage(Device& device, uint32_t side, const StreamHeader& header)
    : extent_(side, side, 1),
      image_(
          *device.state().device,
          vk::ImageCreateInfo(
              {}, vk::ImageType::e2D,
              texel_bytes(header) == 8 ? vk::Format::eR16G16B16A16Uint : vk::Format::eR8G8B8A8Unorm,
              extent_, 1, 2, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
              vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst)),
      memory_(memory_of(device.state(), image_)) {
  image_.bindMemory(*memory_, 0);
}

void ProgramImage::clear(const vk::raii::CommandBuffer& commands) const {
  commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {},
                           image_barrier(*image_, {}, Access::eTransferWrite, Layout::eUndefined,
                                         Layout::eTransferDstOptimal));
  commands.clearColorImage(*image_, Layout::eTransferDstOptimal, vk::ClearColorValue(),
                           kBothLayers);
}

void ProgramImage::read(const vk::raii::CommandBuffer& commands, vk::Buffer to) const {
  commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {},
                           image_barrier(*image_, Access::eTransferWrite, Access::eTransferRead,
                                         Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal));
  const vk::ImageSubresourceLayers layers(vk::ImageAspectFlagBits::eColor, 0, 0, 2);
  commands.copyImageToBuffer(*image_, Layout::eTransferSrcOptimal, to,
                             vk::BufferImageCopy(0, 0, 0, layers, {}, extent_));
}

ProgramFrames::ProgramFrames(Device& device, uint64_t bytes)
    : device_(&device.state()),
      commands_(allocate_commands(*device_, kUnderWay)),
      done_{signalled_fence(*device_), signalled_fence(*device_), signalled_fence(*device_)},
      targets_{Buffer(*device_, bytes, Memory::kReadback),
               Buffer(*device_, bytes, Memory::kReadback),
               Buffer(*device_, bytes, Memory::kReadback)} {}

ProgramFrames::~ProgramFrames() {
  for (size_t slot = 0; slot < kUnderWay; ++slot) wait(slot);
}

Outcome<uint64_t> ProgramFrames::draw(GpuRenderer& renderer, const FrameRecord& frame,
                                      int stop_level) {
  const size_t slot = number_ % kUnderWay;
  wait(slot);
  const vk::raii::CommandBuffer& commands = commands_[slot];
  commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  const auto recorded = record(renderer, *commands, frame, stop_level,
                               BufferTarget{targets_[slot].handle(), 0}, recordings_[slot]);
  if (!recorded) return tl::unexpected(recorded.error());
  end(commands);
  device_->device->resetFences(*done_[slot]);
  const vk::CommandBuffer handle = *commands;
  device_->queue->submit(vk::SubmitInfo({}, {}, handle), *done_[slot]);
  return ++number_;
}

RecordedFrame ProgramFrames::result(uint64_t number) {
  wait((number - 1) % kUnderWay);
  return recordings_[(number - 1) % kUnderWay].result();
}

std::span<const uint8_t> ProgramFrames::texels(uint64_t number) const {
  return targets_[(number - 1) % kUnderWay].bytes();
}

void ProgramFrames::wait(size_t slot) const {
  const auto waited = device_->device->waitForFences(*done_[slot], VK_TRUE, UINT64_MAX);
  if (waited != vk::Result::eSuccess) std::abort();
}

void ProgramFrames::fill(uint8_t byte) {
  for (const Buffer& target : targets_) std::ranges::fill(target.bytes(), byte);
}

}  // namespace hmlfc::gpu
