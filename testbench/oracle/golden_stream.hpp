// A stream as the decode unit opens it, with the golden model's parts that decode it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <hmlfc/error.hpp>

#include "decoder/fast/sparse_plane.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/key_images.hpp"
#include "oracle/request.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::tb {

/// The unit's own limits (FIL-7).
inline constexpr uint32_t kMaxUnitSide = 16384;
inline constexpr uint32_t kMaxUnitGrid = 1024;
inline constexpr int kMaxUnitHeight = 7;

/// Whether a unit of these parameters refuses every stream with this header: limit_exceeded
/// (FIL-7).
bool exceeds_limits(const StreamHeader& header, const UnitParameters& unit);

/// An open stream. The file's bytes must outlive it. Not to be copied: its parts refer to each
/// other.
class GoldenStream {
 public:
  /// What LOAD checks, in its order: the header (FIL-4, EXT-1), the unit's limits, the sizes of
  /// ROOT and GROUP. After these the TOP table, which is software's to check (KEY-1).
  static Result<std::unique_ptr<GoldenStream>> open(std::span<const uint8_t> file,
                                                    const UnitParameters& unit);

  /// Whether an error of open() is one of the TOP table, which LOAD does not look at.
  static bool is_of_top_table(const Error& error) {
    return error.section == Section::kTop &&
           (error.code == ErrorCode::kBadTopEntry || error.code == ErrorCode::kBadSectionSize);
  }

  const StreamView& view() const { return view_; }
  const Geometry& geometry() const { return view_.geometry; }
  const StreamHeader& header() const { return view_.header; }
  const KeyImages& keys() const { return keys_; }
  const SparseReferences& references() const { return references_; }

  /// Reads reference blocks on demand, or holds reference images once decoded.
  DecodeSources on_demand() const { return {view_, keys_, nullptr}; }
  DecodeSources sparse() const { return {view_, keys_, &references_}; }

 private:
  explicit GoldenStream(StreamView view)
      : view_(std::move(view)), keys_(view_), references_(view_) {}

  StreamView view_;
  KeyImages keys_;
  SparseReferences references_;
};

}  // namespace hmlfc::tb
