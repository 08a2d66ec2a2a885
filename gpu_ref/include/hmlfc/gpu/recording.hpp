// Decoding, and frames, recorded into a command buffer of the caller, to one of the caller's
// buffers or images.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

#include <hmlfc/format.hpp>
#include <hmlfc/gpu/decoder.hpp>
#include <hmlfc/gpu/device.hpp>
#include <hmlfc/gpu/renderer.hpp>

namespace hmlfc::gpu {

/// Pixels become *texels*: R, G, B and A, each a sample of the stream's depth d in an unsigned
/// integer, of 8 bits where d is 8, else of 16. A is 2^d - 1; all four are 0 in a block that has an
/// error.
///
/// Bytes of a texel: 4 or 8.
uint32_t texel_bytes(const StreamHeader& header);

/// The part of `area` that is inside the view, in pixels; 0 x 0 beyond it.
VkExtent2D texel_extent(const PixelArea& area, const StreamHeader& header);

/// A buffer made with VK_BUFFER_USAGE_TRANSFER_DST_BIT.
struct BufferTarget {
  VkBuffer buffer = VK_NULL_HANDLE;
  uint64_t offset = 0;  ///< of the first texel, a multiple of 4
};

/// Where the first texel of an area goes.
struct TexelPlace {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t layer = 0;  ///< of the image
};

/// A colour image of VK_IMAGE_TYPE_2D with one sample a texel, made with
/// VK_IMAGE_USAGE_TRANSFER_DST_BIT, of a format R8G8B8A8 at depth 8, else R16G16B16A16.
struct ImageTarget {
  VkImage image = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;  ///< or VK_IMAGE_LAYOUT_GENERAL
  uint32_t mip_level = 0;
  std::span<const TexelPlace> places;  ///< one an area, in their order; one for a frame
};

/// What recorded commands use on the device. It outlives their last run.
class Recording {
 public:
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;
  ~Recording();

  /// Errors of the last run, once the host has waited for it: of annex A, 0 for none, one a block
  /// of the areas, area by area, in each row by row. The status is that of Y, Co or Cg, in this
  /// order.
  std::vector<uint8_t> statuses() const;

  struct State;
  explicit Recording(std::unique_ptr<State> state);

 private:
  std::unique_ptr<State> state_;
};

/// Records into `commands` that `areas` of the decoder's stream are decoded to `target`: to a
/// buffer area by area without gaps, each row by row; to an image each area at its place. Blocks
/// that the stream does not have get bad_request; areas beyond the view write no texels.
///
/// `commands` is a primary command buffer of the queue family of the decoder's Device, being
/// recorded, outside a render pass. It may be submitted to that Device's queue and no other, again
/// and again. Its bound compute pipeline and its push constants are others afterwards. Device and
/// decoder outlive its last run.
///
/// Synchronisation: the commands are ordered among themselves and after all compute and transfer
/// commands before them on the queue. The target is written by transfer commands:
/// VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT. The caller orders its other uses
/// of it before and after that, by barriers, or by semaphores of its own around the submission, and
/// brings the image into its layout. Nothing is submitted, and no fence or semaphore is used.
///
/// kLimit: more blocks than DeviceOptions::submission_bytes or the device allow in one recording;
/// places that are not one an area. Nothing is recorded then, nor with no areas.
Outcome<Recording> record(const GpuDecoder& decoder, VkCommandBuffer commands,
                          std::span<const PixelArea> areas, const BufferTarget& target);

/// Records the same to an image.
Outcome<Recording> record(const GpuDecoder& decoder, VkCommandBuffer commands,
                          std::span<const PixelArea> areas, const ImageTarget& target);

/// What became of a recorded frame.
struct RecordedFrame {
  /// The error of NED-2, or bad_request where record or stop level do not fit the light field.
  ErrorCode status = ErrorCode::kOk;
  bool had_room = true;        ///< for its blocks on the device
  uint64_t blocks_needed = 0;  ///< as in GpuFrame
  uint64_t blocks_decoded = 0;
  uint64_t disparities_looked_up = 0;
};

/// What a recorded frame uses on the device, for one run at a time: a program with three frames
/// under way has three, which it uses in turn. It outlives the last run.
class FrameRecording {
 public:
  FrameRecording();
  FrameRecording(FrameRecording&&) noexcept;
  FrameRecording& operator=(FrameRecording&&) noexcept;
  ~FrameRecording();

  /// What the last run gave, once the host has waited for it. Where it had no room or its status is
  /// not kOk, all texels are 0.
  RecordedFrame result() const;

  /// For this project's own files.
  struct State;
  std::unique_ptr<State>& state() { return state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Records into `commands` that `renderer` draws the frame of `record` to `target`, as
/// GpuRenderer::render would: its texels row by row, or at the place of an image. With what is held
/// of earlier frames, in the order in which the device runs them, whoever has submitted them. A
/// frame with a status of bad_request records nothing.
///
/// Allocates and waits for nothing once `recording` has recorded a frame of this size, but for the
/// maps of the renderer's first frame with geometry. The last run of `recording` is over, also for
/// the host; the next one may be submitted again once it is over. `commands`, their synchronisation
/// and the target are as with the areas of a decoder.
///
/// A frame that finds no room on the device draws nothing: with no recorded frame under way, render
/// it with GpuRenderer::render, which makes room, and record anew what was recorded before. So does
/// any frame that the renderer submits itself and that has no room.
///
/// kLimit: places that are not one, and as with GpuRenderer::begin.
Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const BufferTarget& target, FrameRecording& recording);

/// Records the same to an image.
Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const ImageTarget& target, FrameRecording& recording);

}  // namespace hmlfc::gpu
