// Novel views of a light field (docs/rendering.md), from the blocks that they need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc {

/// The work of one frame. Blocks are those of NED-1.
struct FrameCounts {
  uint64_t blocks_needed = 0;          ///< decoded + reused
  uint64_t blocks_decoded = 0;         ///< for this frame
  uint64_t blocks_reused = 0;          ///< from the cache
  uint64_t samples_interpolated = 0;   ///< samples R, G and B of views with a weight above 0
  uint64_t disparities_looked_up = 0;  ///< blocks whose disparity geometry looks up (SRF-5)

  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

/// Wall-clock time of the stages of one frame.
struct FrameSeconds {
  double plan = 0;    ///< finding the blocks that are needed
  double decode = 0;  ///< of the missing ones, to RGB
  double sample = 0;  ///< rays, weights and sums

  /// All stages.
  double total() const { return plan + decode + sample; }
};

/// A rendered frame.
struct Frame {
  RgbImage image;        ///< frame_width x frame_height, of the light field's depth
  FrameCounts counts;    ///< what the renderer did for it
  FrameSeconds seconds;  ///< how long that took
};

/// Renders frames of one light field, one frame at a time.
class HMLFC_EXPORT FrameRenderer {
 public:
  virtual ~FrameRenderer() = default;

  /// Renders the frame of `record`, made by frame_record for this light field, from views decoded
  /// down to `stop_level` (DEC-1), into `frame`, whose memory is reused. Every renderer returns the
  /// same pixels. Errors: those of NED-2; bad_request where record or stop_level do not fit the
  /// light field; out_of_memory.
  virtual Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) = 0;
};

/// How a renderer works; nothing here changes a frame.
struct RenderOptions {
  size_t cache_bytes = size_t{256} << 20;  ///< decoded pixels kept between frames; 0: none
  int threads = 0;                         ///< 0: all cores
  /// For callers that render each frame at stop levels from coarse to fine: keeps what was decoded
  /// of a stop level, so that the next one starts from there.
  bool progressive = false;
};

/// The fast renderer on the CPU. `decoder` must outlive it.
HMLFC_EXPORT std::unique_ptr<FrameRenderer> make_cpu_renderer(const Decoder& decoder,
                                                              const RenderOptions& options = {});

/// The golden renderer: docs/rendering.md as it reads, pixel by pixel, block by block, with
/// Decoder::decode_block, on one thread. `decoder` must outlive it.
HMLFC_EXPORT std::unique_ptr<FrameRenderer> make_golden_renderer(const Decoder& decoder);

/// What a frame takes, known before its blocks are decoded.
struct FrameNeeds {
  std::vector<BlockAddress> blocks;    ///< those of NED-1 in the order of NED-2; with a stop level
                                       ///< each by the first view that shows its image
  uint64_t disparities_looked_up = 0;  ///< SRF-5
  uint64_t pixels_outside = 0;         ///< RAY-2, RAY-3, RAY-5
};

/// What the frame of `record` from views decoded down to `stop_level` takes. Errors: bad_request
/// where record or stop_level do not fit the light field, out_of_memory.
HMLFC_EXPORT Result<FrameNeeds> frame_needs(const Decoder& decoder, const FrameRecord& record,
                                            int stop_level);

/// A frame without rounding: the real frame of docs/rendering.md, section 7, in double precision,
/// which the fixed point is measured against.
struct RealFrame {
  uint32_t width = 0;           ///< [1, 4096] pixels
  uint32_t height = 0;          ///< [1, 4096] pixels
  std::vector<uint8_t> inside;  ///< 1 for each pixel that is inside (RAY-5), row by row, else 0
  std::vector<double> samples;  ///< R, G, B of each pixel in [0, 2^depth - 1]; 0 outside
  double max_displacement = 0;  ///< the largest displacement of a cell (SRF-6), pixels a column
};

/// The real frame of `camera`, which frame_record accepts for this light field, from views decoded
/// whole down to `stop_level`. Errors: those of Decoder::decode_view, out_of_memory.
HMLFC_EXPORT Result<RealFrame> render_real(const Decoder& decoder, const Camera& camera,
                                           int stop_level = 0);

/// The bound of ERR-1 on |frame - real frame| for filter quadrilinear at pixels that are inside in
/// both, in samples of the light field's depth. For a frame with geometry `max_displacement` is
/// that of its real frame (SRF-6).
HMLFC_EXPORT double fixed_point_bound(const Camera& camera, const StreamHeader& header,
                                      double max_displacement = 0);

/// The mean squared difference of the samples of `frame` from those of `real`, a frame of the same
/// size, over all pixels.
HMLFC_EXPORT double mean_squared_error(const RgbImage& frame, const RealFrame& real);

}  // namespace hmlfc
