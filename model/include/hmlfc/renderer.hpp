// Novel views of a light field (docs/rendering.md): frames in, from the blocks that they need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc {

/// What one frame took. Blocks are those of NED-1.
struct FrameCounts {
  uint64_t blocks_needed = 0;         ///< decoded + reused
  uint64_t blocks_decoded = 0;        ///< for this frame
  uint64_t blocks_reused = 0;         ///< of frames before, from the cache
  uint64_t samples_interpolated = 0;  ///< of R, G and B of views, read with a weight above 0

  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

/// Wall-clock time of the stages of one frame.
struct FrameSeconds {
  double plan = 0;    ///< which blocks are needed
  double decode = 0;  ///< the missing ones, to RGB
  double sample = 0;  ///< rays, weights and sums

  double total() const { return plan + decode + sample; }
};

/// A rendered frame.
struct Frame {
  RgbImage image;  ///< frame_width x frame_height, of the light field's depth
  FrameCounts counts;
  FrameSeconds seconds;
};

/// Renders frames of one light field. One frame at a time.
class FrameRenderer {
 public:
  virtual ~FrameRenderer() = default;

  /// Renders the frame of `record`, made by frame_record for this light field, from views decoded
  /// down to `stop_level` (DEC-1), into `frame`, whose memory is used again. Errors: those of
  /// NED-2; bad_request where record or stop_level do not fit the light field; out_of_memory.
  virtual Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) = 0;
};

/// How the renderer on the CPU works; nothing here changes a frame.
struct RenderOptions {
  size_t cache_bytes = size_t{256} << 20;  ///< of decoded pixels kept between frames
  int threads = 0;                         ///< 0: all cores
  /// Frames are asked for from coarse to fine: what is decoded of a stop level is kept so that the
  /// one below it is decoded from there.
  bool progressive = false;
};

/// The fast renderer on the CPU. `decoder` must outlive it.
std::unique_ptr<FrameRenderer> make_cpu_renderer(const Decoder& decoder,
                                                 const RenderOptions& options = {});

/// The golden renderer: docs/rendering.md line by line, pixel by pixel, block by block, with
/// Decoder::decode_block, on one thread. `decoder` must outlive it.
std::unique_ptr<FrameRenderer> make_golden_renderer(const Decoder& decoder);

}  // namespace hmlfc
