// A program that records decoding and frames into command buffers of its own.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/gpu/recording.hpp>
#include <hmlfc/renderer.hpp>

#include "device/buffer.hpp"
#include "gpu/gpu_test.hpp"

namespace hmlfc::gpu {

/// A stream of the encoder, or one with random fields: of any depth, in both chroma formats.
std::vector<uint8_t> stream_of(uint32_t seed);

/// The samples of texels, R, G, B and A in turn.
std::vector<uint16_t> samples_of(std::span<const uint8_t> texels, const StreamHeader& header);

/// The texels of a frame of the golden renderer, which gave `drawn` and `frame` for `record`: R, G,
/// B and A in turn; all 0 for an error.
std::vector<uint16_t> texels_of(const Result<void>& drawn, const Frame& frame,
                                const FrameRecord& record, const StreamHeader& header);

/// Tests on a device of their own, without a message of the validation layer where that is there.
class ProgramTest : public GpuTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  Device& program() { return *program_; }
  Buffer target(uint64_t bytes) { return {program_->state(), bytes, Memory::kReadback}; }

 private:
  std::optional<Device> program_;
};

/// Commands that are recorded once and run when asked.
class ProgramCommands {
 public:
  using Record = std::function<void(const vk::raii::CommandBuffer&)>;
  ProgramCommands(Device& device, const Record& record);

  void run() const;

 private:
  Device::State* device_;
  vk::raii::CommandBuffer commands_;
};

/// An image of two layers that commands copy from and to.
class ProgramImage {
 public:
  ProgramImage(Device& device, uint32_t side, const StreamHeader& header);

  vk::Image handle() const { return *image_; }

  /// Everything becomes 0 and the layout TRANSFER_DST_OPTIMAL, before later transfers.
  void clear(const vk::raii::CommandBuffer& commands) const;

  /// Copies both layers to `to`, after earlier transfers.
  void read(const vk::raii::CommandBuffer& commands, vk::Buffer to) const;

 private:
  vk::Extent3D extent_;
  vk::raii::Image image_;
  vk::raii::DeviceMemory memory_;
};

/// Draws frames, three under way, into buffers of `bytes` bytes each.
class ProgramFrames {
 public:
  static constexpr uint32_t kUnderWay = 3;

  ProgramFrames(Device& device, uint64_t bytes);
  ProgramFrames(const ProgramFrames&) = delete;
  ProgramFrames& operator=(const ProgramFrames&) = delete;
  ~ProgramFrames();

  /// Records and submits a frame; returns the number of frames so far. Waits where three are under
  /// way.
  Outcome<uint64_t> draw(GpuRenderer& renderer, const FrameRecord& frame, int stop_level);

  /// The result and the texels of one of the last three frames, once it is done.
  RecordedFrame result(uint64_t number);
  std::span<const uint8_t> texels(uint64_t number) const;

  void fill(uint8_t byte);

 private:
  void wait(size_t slot) const;

  Device::State* device_;
  vk::raii::CommandBuffers commands_;
  std::array<vk::raii::Fence, kUnderWay> done_;  // signalled while nothing is under way
  std::array<Buffer, kUnderWay> targets_;
  std::array<FrameRecording, kUnderWay> recordings_;
  uint64_t number_ = 0;
};

}  // namespace hmlfc::gpu
