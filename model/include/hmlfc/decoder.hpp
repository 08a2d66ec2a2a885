// The decoder: open a stream, then decode a block, a rectangle, a plane, a view or all views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/image.hpp>
#include <hmlfc/statistics.hpp>
#include <hmlfc/trace.hpp>

namespace hmlfc {

/// What this decoder accepts (FIL-7); a stream beyond it is refused with limit_exceeded.
struct DecoderLimits {
  uint64_t max_plane_samples = uint64_t{1} << 30;  ///< width * height of a view
};

/// Told what a decoder reads for a request; opening the stream is not counted. Called by several
/// threads at once.
class ReadSink {
 public:
  virtual ~ReadSink() = default;

  /// `bytes` bytes from `offset` on, from the start of the file: of the index, of tile records and
  /// of key images.
  virtual void on_read(uint64_t offset, uint64_t bytes) = 0;

  /// A plane of a key image, which is decoded whole (KEY-3) and kept, of `samples` samples.
  virtual void on_key_plane(uint64_t samples) { static_cast<void>(samples); }
};

struct OpenOptions {
  /// Check the CRC of every section (FIL-6), which reads the whole file. Without it a damaged
  /// section is found only where a structural check fails.
  bool check_sections = true;
  DecoderLimits limits{};
  ReadSink* reads = nullptr;  ///< must outlive the decoder
};

/// A place in the grid of views.
struct ViewPos {
  uint32_t row = 0;  ///< [0, rows - 1]
  uint32_t col = 0;  ///< [0, cols - 1]
};

/// One block of one view.
struct BlockAddress {
  ViewPos view;
  Plane plane = Plane::kY;
  uint32_t bx = 0;  ///< block column, [0, ceil(plane width / B) - 1]
  uint32_t by = 0;  ///< block row
};

/// A rectangle in samples of a plane, or in pixels of a view.
struct Rect {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t width = 0;
  uint32_t height = 0;
};

/// Size of a plane in samples.
struct PlaneSize {
  uint32_t width = 0;
  uint32_t height = 0;
};

/// Whether reference images are read block by block when needed or decoded once and kept (the
/// paper's sparse storage).
enum class ReferenceMode : uint8_t { kOnDemand, kSparse };

/// Called for each decoded view by decode_all, by several threads at once, each view once.
using ViewConsumer = std::function<void(ViewPos, RgbImage&&)>;

/// Decodes one stream. All const functions may be called from several threads at the same time.
///
/// Every function takes a `stop_level` s in [0, tree_height]: 0 decodes the views, s > 0 shows the
/// ancestor of level s in place of each view (DEC-1). All results are exact (the specification
/// leaves nothing open). Errors are those of annex A; arguments out of range give bad_request.
class Decoder {
 public:
  /// Opens the stream in `file`, the bytes of a whole file, which must outlive the decoder.
  static Result<Decoder> open(std::span<const uint8_t> file, const OpenOptions& options = {});

  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;
  ~Decoder();

  const StreamHeader& header() const;

  /// Size of a plane of one view.
  PlaneSize plane_size(Plane plane) const;

  /// The golden path: B * B samples of one block, row by row; positions outside the plane have no
  /// meaning. `sink` and `counts` may be null.
  Result<std::vector<int32_t>> decode_block(const BlockAddress& block, int stop_level = 0,
                                            TraceSink* sink = nullptr,
                                            AccessCounts* counts = nullptr,
                                            ReferenceMode mode = ReferenceMode::kOnDemand) const;

  /// The samples of `rect`, which lies in the plane, row by row.
  Result<std::vector<int16_t>> decode_rect(ViewPos view, Plane plane, const Rect& rect,
                                           int stop_level = 0) const;

  /// Turns `samples`, those of `rect` at level `stop_level` + 1 as decode_rect gives them, into
  /// those at level `stop_level` by decoding this level alone (DEC-3). `rect` begins at a block's
  /// corner and ends at one or at the plane's border; `stop_level` lies in [0, tree_height - 1].
  /// After an error, which need not be that of decode_rect, the samples have no meaning:
  /// decode_rect says what they are, or why there are none.
  Result<void> refine_rect(ViewPos view, Plane plane, const Rect& rect, int stop_level,
                           std::span<int16_t> samples) const;

  /// A whole plane of a view.
  Result<std::vector<int16_t>> decode_plane(ViewPos view, Plane plane, int stop_level = 0) const;

  /// The pixels of `rect` of a view in RGB (COL-2, COL-3).
  Result<RgbImage> decode_rgb(ViewPos view, const Rect& rect, int stop_level = 0) const;

  /// A whole view in RGB.
  Result<RgbImage> decode_view(ViewPos view, int stop_level = 0) const;

  /// All views, on `threads` threads (0: all cores). Stops at the first error.
  Result<void> decode_all(const ViewConsumer& consumer, int stop_level = 0, int threads = 0) const;

  /// Decodes the reference images of all levels that are not keyed and keeps them, on `threads`
  /// threads.
  Result<void> load_references(int threads = 0) const;

  /// Bytes of decoded reference images held now.
  size_t reference_bytes() const;

  /// Where the bytes of the stream go; reads every tile.
  Result<StreamStatistics> statistics() const;

 private:
  struct State;
  explicit Decoder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc
