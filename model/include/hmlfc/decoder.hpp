// The decoder: open a stream, then decode a block, a rectangle, a plane, a view or all views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <hmlfc/byte_source.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/image.hpp>
#include <hmlfc/read_sink.hpp>
#include <hmlfc/statistics.hpp>
#include <hmlfc/trace.hpp>

namespace hmlfc {

/// Limits of what this decoder accepts (FIL-7); a stream beyond it is refused with limit_exceeded.
struct DecoderLimits {
  uint64_t max_plane_samples = uint64_t{1} << 30;  ///< width * height of a view
  /// Code-blocks of a plane of a key image, for each of which OpenJPEG takes up to 2 KiB. A view of
  /// max_plane_samples has 2^18 of 64x64.
  uint64_t max_code_blocks = uint64_t{1} << 19;
};

/// How to open a stream.
struct OpenOptions {
  /// Check the CRC of every section (FIL-6), which reads, and of a partial source loads, the whole
  /// file. Without it a damaged section is found only where a structural check fails.
  bool check_sections = true;
  DecoderLimits limits{};     ///< of what this decoder accepts
  ReadSink* reads = nullptr;  ///< receives what requests read; must outlive the decoder
};

/// How decode_block gets reference blocks; the samples are the same.
enum class ReferenceMode : uint8_t {
  kOnDemand,  ///< block by block, each when it is needed
  kSparse,    ///< from reference images decoded once and kept (the paper's sparse storage)
};

/// How to decode one block.
struct BlockOptions {
  int stop_level = 0;                                   ///< [0, tree_height]
  TraceSink* trace = nullptr;                           ///< receives every field and stage
  AccessCounts* counts = nullptr;                       ///< the cost of the block is added to it
  ReferenceMode references = ReferenceMode::kOnDemand;  ///< never changes the result
};

/// How to decode all views.
struct DecodeAllOptions {
  int stop_level = 0;  ///< [0, tree_height]
  int threads = 0;     ///< 0: all cores; never changes the result
};

/// Called by decode_all once for each view, by several threads at once.
using ViewConsumer = std::function<void(ViewPos, RgbImage&&)>;

/// Decodes one stream. Several threads may call const functions at the same time.
///
/// Every function takes a `stop_level` s in [0, tree_height]: 0 decodes the views, s > 0 shows the
/// ancestor of level s instead of each view (DEC-1). All results are exact: the specification
/// leaves nothing open. Errors are those of annex A; arguments out of range give bad_request.
class HMLFC_EXPORT Decoder {
 public:
  /// Opens the stream in `file`, the bytes of a whole file, which must outlive the decoder. Errors:
  /// those of FIL-8.
  static Result<Decoder> open(std::span<const uint8_t> file, const OpenOptions& options = {});

  /// Opens the file in `source`, which must outlive the decoder. Whatever a request needs of
  /// a partial source is loaded first, in few calls of load(). Where it cannot be loaded, this and
  /// every later request give bus_error, and no samples.
  static Result<Decoder> open(ByteSource& source, const OpenOptions& options = {});

  /// The decoder moved from may only be assigned to or destroyed.
  Decoder(Decoder&&) noexcept;
  /// The decoder moved from may only be assigned to or destroyed.
  Decoder& operator=(Decoder&&) noexcept;
  ~Decoder();

  /// The stream's header; it lives as long as the decoder, also when the decoder is moved.
  const StreamHeader& header() const;

  /// Size of a plane of one view.
  PlaneSize plane_size(Plane plane) const;

  /// The golden path: B * B samples of one block, row by row; positions outside the plane have no
  /// meaning.
  Result<std::vector<int32_t>> decode_block(const BlockAddress& block,
                                            const BlockOptions& options = {}) const;

  /// The samples of `rect`, which lies in the plane, row by row.
  Result<std::vector<int16_t>> decode_rect(ViewPos view, Plane plane, const Rect& rect,
                                           int stop_level = 0) const;

  /// Turns `samples`, those of `rect` at level `stop_level` + 1 as decode_rect gives them, into
  /// those at level `stop_level` by decoding this level alone (DEC-3). `rect` begins at a block's
  /// corner and ends at one or at the plane's border; `stop_level` lies in [0, tree_height - 1].
  /// After an error the samples have no meaning, and the error need not be that of decode_rect:
  /// call decode_rect for the samples or the right error.
  Result<void> refine_rect(ViewPos view, Plane plane, const Rect& rect, int stop_level,
                           std::span<int16_t> samples) const;

  /// A whole plane of a view, row by row.
  Result<std::vector<int16_t>> decode_plane(ViewPos view, Plane plane, int stop_level = 0) const;

  /// The pixels of `rect`, which lies in the view, in RGB (COL-2, COL-3).
  Result<RgbImage> decode_rgb(ViewPos view, const Rect& rect, int stop_level = 0) const;

  /// A whole view in RGB.
  Result<RgbImage> decode_view(ViewPos view, int stop_level = 0) const;

  /// Decodes all views and hands each to `consumer`. Stops at the first error.
  Result<void> decode_all(const ViewConsumer& consumer, const DecodeAllOptions& options = {}) const;

  /// Decodes the reference images of all levels that are not keyed and keeps them, on `threads`
  /// threads (0: all cores), so that later requests do not wait for them.
  Result<void> load_references(int threads = 0) const;

  /// Bytes of decoded reference images held now.
  size_t reference_bytes() const;

  /// Where the bytes of the stream go; reads every tile that is not empty. Errors: those of
  /// records; limit_exceeded where tiles share records, four or more on average each byte of TILE,
  /// and are over 2^20.
  Result<StreamStatistics> statistics() const;

 private:
  friend struct DecoderAccess;
  struct State;
  explicit Decoder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc
