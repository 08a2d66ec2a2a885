// Novel views on a Vulkan device (docs/rendering.md): a frame record in, the same bytes out as from
// the renderers on the CPU.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/image.hpp>

#include "device.hpp"
#include "failure.hpp"
#include "fields/stream_view.hpp"
#include "gpu_decoder.hpp"

namespace hmlfc::gpu {

/// A frame from the device.
struct GpuFrame {
  /// The error of NED-2, or bad_request where record or stop level do not fit the light field; then
  /// there is no image.
  ErrorCode status = ErrorCode::kOk;
  RgbImage image;              ///< frame_width x frame_height, of the light field's depth
  uint64_t blocks_needed = 0;  ///< NED-1; all of them were decoded, each once
  unsigned submissions = 0;    ///< 1, or 2 where the frame needed more blocks than any before
};

/// Renders frames of one stream, one at a time. The device must outlive it.
class GpuRenderer {
 public:
  /// Uploads the stream as GpuDecoder::open does.
  static Outcome<GpuRenderer> open(Device& device, const StreamView& stream);

  GpuRenderer(GpuRenderer&&) noexcept;
  GpuRenderer& operator=(GpuRenderer&&) noexcept;
  ~GpuRenderer();

  /// Renders the frame of `record`, made by frame_record for this light field, from views decoded
  /// down to `stop_level` (DEC-1): the device marks the blocks that the frame needs, decodes them
  /// and no others, and draws, in one submission.
  Outcome<GpuFrame> render(const FrameRecord& record, int stop_level);

  /// Of the last submission; empty where the device has no timestamps.
  const std::vector<StageTime>& stage_times() const;

 private:
  struct State;
  explicit GpuRenderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc::gpu
