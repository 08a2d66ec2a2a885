// The error of a frame, separated into its causes.
#pragma once

#include <map>
#include <tuple>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>
#include <hmlfc/renderer.hpp>

namespace hmlfc::bench {

/// Mean squared differences over all pixels and R, G, B, in samples. Real frames are those of
/// docs/rendering.md, section 7, in double precision; the source is the uncompressed light field.
struct FrameErrors {
  double total = 0;   ///< the frame against the source's real frame of filter quadrilinear
  double stream = 0;  ///< real frames, quadrilinear: stream at the frame's level against source
  double filter = 0;  ///< real frames of the source: the frame's filter against quadrilinear
  double fixed = 0;   ///< the frame against the stream's real frame of its filter and level
  double largest_fixed = 0;  ///< largest absolute difference of these two

  void add(const FrameErrors& other);
};

/// The errors of frames that one camera takes. Real frames are drawn when needed, and kept.
class FrameComparison {
 public:
  /// `source` decodes to the uncompressed light field. Both decoders must outlive this.
  FrameComparison(const Decoder& stream, const Decoder& source, const Camera& camera)
      : stream_(stream), source_(source), camera_(camera) {}

  /// Of `image`, drawn from the stream with `filter` down to `stop_level`. Throws
  /// std::runtime_error where a stream does not decode.
  FrameErrors errors(const RgbImage& image, Filter filter, int stop_level);

 private:
  enum class From { kStream, kSource };

  const RealFrame& real(From from, Filter filter, int stop_level);

  const Decoder& stream_;
  const Decoder& source_;
  Camera camera_;
  std::map<std::tuple<From, Filter, int>, RealFrame> frames_;
};

}  // namespace hmlfc::bench
