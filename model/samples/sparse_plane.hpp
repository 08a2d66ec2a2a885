// Decoded reference images below the top level, stored sparsely: blocks without a residual take no
// values.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "fields/stream_view.hpp"
#include "samples/disparity_plane.hpp"
#include "samples/lazy_map.hpp"
#include "samples/reference_blocks.hpp"

namespace hmlfc {

/// The residuals of one plane of one reference image (TIL-10, STP-3). Immutable once built.
class SparsePlane {
 public:
  /// Reads every block of plane `plane` of reference image `image` of level `level`. Never fails: a
  /// block that does not decode keeps its error and returns it when it is asked for, as reading it
  /// on demand would.
  static SparsePlane read(const StreamView& stream, int level, ImagePos image, Plane plane);

  /// The block's B * B residuals, or null where all are 0; the block's error where it has one.
  Result<const int16_t*> find(uint32_t bx, uint32_t by) const;

  unsigned block_size() const { return block_size_; }

  /// Bytes held.
  size_t bytes() const;

 private:
  struct Tile {
    uint64_t coded = 0;        // blocks with values, by block number
    uint64_t failed = 0;       // blocks with an error
    uint32_t first_block = 0;  // index of its first block in values_, in blocks
    uint32_t first_error = 0;
  };

  void read_tile(const StreamView& stream, const BlockSite& site);

  unsigned block_size_ = 4;
  uint32_t tiles_x_ = 0;
  std::vector<Tile> tiles_;
  std::vector<int16_t> values_;
  std::vector<Error> errors_;
};

/// The sparse planes and disparities of all reference images that were needed so far. Thread-safe.
class SparseReferences {
 public:
  explicit SparseReferences(const StreamView& stream) : stream_(stream) {}

  /// The plane of reference image `image` of level `level`, which is not keyed.
  Result<std::shared_ptr<const SparsePlane>> plane(int level, ImagePos image, Plane plane) const;

  /// The disparities of reference image `image` of level `level` in motion plane `motion_plane`;
  /// the stream has shared_disparity.
  Result<std::shared_ptr<const DisparityPlane>> disparities(int level, ImagePos image,
                                                            size_t motion_plane) const;

  /// Bytes of all that was read so far.
  size_t bytes() const;

 private:
  const StreamView& stream_;
  mutable LazyMap<SparsePlane> planes_;
  mutable LazyMap<DisparityPlane> disparities_;
};

/// A sparse plane as a reference for the golden decoder.
class SparseReference final : public ReferenceBlocks {
 public:
  explicit SparseReference(const SparsePlane& plane) : plane_(plane) {}
  Result<BlockValues> block(uint32_t bx, uint32_t by) override;

 private:
  const SparsePlane& plane_;
};

}  // namespace hmlfc
