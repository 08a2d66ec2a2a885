// A stream as the decode unit opens it, with the golden model's parts that decode it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>

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

/// Reference blocks as the golden path reads them, the latest of them kept. Thread-safe.
class GoldenReferences final : public HeldReferences {
 public:
  /// `stream` must outlive it.
  explicit GoldenReferences(const StreamView& stream) : stream_(stream) {}

  Result<BlockValues> block(const BlockSite& site) const override;

 private:
  struct Shard {
    std::mutex mutex;
    std::unordered_map<uint64_t, Result<BlockValues>> blocks;  // by site
  };

  const StreamView& stream_;
  mutable std::array<Shard, 16> shards_;
};

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

  /// The residuals of reference blocks by each path.
  const GoldenReferences& golden_references() const { return golden_; }
  const SparseReferences& fast_references() const { return fast_; }

 private:
  explicit GoldenStream(StreamView view)
      : view_(std::move(view)), keys_(view_), golden_(view_), fast_(view_) {}

  StreamView view_;
  KeyImages keys_;
  GoldenReferences golden_;
  SparseReferences fast_;
};

}  // namespace hmlfc::tb
