// Decoded reference images below the top level, stored sparsely: blocks without a residual take no
// values.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "decoder/fast/motion_field.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/key_images.hpp"
#include "decoder/lazy_map.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// The residuals of one plane of one reference image (TIL-10, STP-3). Each tile is read when one of
/// its blocks is first asked for. Thread-safe.
class SparsePlane {
 public:
  /// Plane `plane` of reference image `image` of level `level`; `stream` must outlive it.
  SparsePlane(const StreamView& stream, int level, ImagePos image, Plane plane);

  /// The block's B * B residuals, or null where all are 0. A block that does not decode has its
  /// error, as reading it on demand would.
  Result<const int16_t*> find(uint32_t bx, uint32_t by) const;

  /// Reads every tile that was not read yet.
  void read_all() const;

  unsigned block_size() const { return block_size_; }

  /// Bytes held.
  size_t bytes() const;

 private:
  struct Tile {
    uint64_t coded = 0;   // blocks with values, by block number
    uint64_t failed = 0;  // blocks with an error
    std::vector<int16_t> values;
    std::vector<Error> errors;
  };

  const Tile& tile_at(size_t number) const;
  void read_tile(const BlockSite& site, Tile& tile) const;
  void read_blocks(const BlockSite& site, Tile& tile) const;

  const StreamView& stream_;
  BlockSite site_;  // with the block 0, 0
  unsigned block_size_;
  uint32_t tiles_x_;
  mutable std::vector<Tile> tiles_;
  mutable FilledParts read_;  // by tile
};

/// The sparse planes and disparities of all reference images that were needed so far. Thread-safe.
class SparseReferences final : public HeldReferences {
 public:
  explicit SparseReferences(const StreamView& stream) : stream_(stream) {}

  /// The plane of reference image `image` of level `level`, which is not keyed.
  std::shared_ptr<const SparsePlane> plane(int level, ImagePos image, Plane plane) const;

  /// The disparities of reference image `image` of level `level` in motion plane `motion_plane`;
  /// the stream has shared_disparity.
  std::shared_ptr<const DisparityPlane> disparities(int level, ImagePos image,
                                                    size_t motion_plane) const;

  Result<BlockValues> block(const BlockSite& site) const override;

  /// Bytes of all that was read so far.
  size_t bytes() const;

 private:
  const StreamView& stream_;
  mutable LazyMap<SparsePlane> planes_;
  mutable LazyMap<DisparityPlane> disparities_;
};

/// Sources of the fast path.
struct FastSources {
  const StreamView& stream;
  const KeyImages& keys;
  const SparseReferences& references;
  /// Where not null, key images that are not decoded yet are only requested, and what is decoded
  /// from them has no meaning.
  KeyRequests* requests = nullptr;

  /// Plane `plane` of key image `at` of level `level`; errors as for KeyImages::plane.
  Result<std::shared_ptr<const SamplePlane>> key_plane(int level, ImagePos at, Plane plane) const {
    if (requests != nullptr) return keys.plane_or_request(level, at, plane, *requests);
    return keys.plane(level, at, plane);
  }
};

}  // namespace hmlfc
