// Novel views on a Vulkan device (docs/rendering.md): a frame record in, the same bytes out as from
// the renderers on the CPU.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/gpu/decoder.hpp>
#include <hmlfc/gpu/device.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc::gpu {

/// A frame from the device.
struct GpuFrame {
  /// The error of NED-2, or bad_request where record or stop level do not fit the light field; then
  /// there is no image.
  ErrorCode status = ErrorCode::kOk;
  RgbImage image;                      ///< frame_width x frame_height, of the light field's depth
  uint64_t blocks_needed = 0;          ///< NED-1
  uint64_t blocks_decoded = 0;         ///< of them, each once; the others are held of frames before
  uint64_t disparities_looked_up = 0;  ///< SRF-5
  unsigned submissions = 0;            ///< 1, or 2 where the frame took more room than any before
};

/// Where the picture of a frame goes.
enum class FrameOutput : uint8_t {
  kHost,    ///< to GpuFrame::image
  kDevice,  ///< it stays in a buffer of the device, and GpuFrame::image is empty
};

/// Renders frames of one stream. The device must outlive it.
class GpuRenderer {
 public:
  /// Uploads the stream as GpuDecoder::open does; its bytes, or their source, must outlive the
  /// renderer: the first frame with geometry reads them, a row of views at a time. Between
  /// frames the device keeps up to `cache_bytes` bytes of decoded samples, in pages of 32 blocks; 0
  /// keeps nothing. No frame depends on it.
  static Outcome<GpuRenderer> open(Device& device, const Decoder& stream, uint64_t cache_bytes);

  /// The same, for this project's own programs.
  static Outcome<GpuRenderer> open(Device& device, const StreamView& stream, uint64_t cache_bytes);

  /// Renders the frame of `record`, made by frame_record for this light field, from views decoded
  /// down to `stop_level` (DEC-1): the device marks the blocks that the frame needs, decodes those
  /// of them that it does not hold and no others, and draws, in one submission. After a frame with
  /// an error, and before one of another stop level, nothing is held. The first frame with
  /// geometry reads the disparity maps of all views and uploads them; kLimit where they take more
  /// than DeviceOptions::disparity_bytes.
  Outcome<GpuFrame> render(const FrameRecord& record, int stop_level);

  /// Submits a frame as render() does, and does not wait for it, but for the maps of the first one
  /// with geometry. kLimit where most_under_way() frames have begun and not been finished.
  Outcome<void> begin(const FrameRecord& record, int stop_level, FrameOutput output);

  /// Frames begun and not yet finished.
  unsigned under_way() const;

  /// Frames that may be under way at once, 1 or more.
  static unsigned most_under_way();

  /// Whether finish() would not wait: the first of them is done.
  Outcome<bool> ready();

  /// Finishes the first of the frames under way; waits for it. `frame` is written over, and its
  /// memory used again. After a failure the frame is no longer under way.
  Outcome<void> finish(GpuFrame& frame);

  /// The device address of the picture that finish() finished last: three samples of 16 bits a
  /// pixel, row by row, with an unspecified pixel after each row of an odd width. It stays
  /// there until most_under_way() more frames have begun.
  uint64_t picture_address() const;

  /// Nothing is held any more: the next frame decodes all that it needs.
  void forget();

  /// Times of the frame finished last; empty where the device has no timestamps, and once another
  /// frame has begun in its place.
  const std::vector<StageTime>& stage_times() const;

  /// For this project's own files (renderer_state.hpp).
  struct State;
  explicit GpuRenderer(std::shared_ptr<State> state) : state_(std::move(state)) {}
  const std::shared_ptr<State>& state() const { return state_; }

 private:
  std::shared_ptr<State> state_;  // of all copies
};

}  // namespace hmlfc::gpu
