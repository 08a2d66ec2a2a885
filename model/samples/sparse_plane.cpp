#include "samples/sparse_plane.hpp"

#include "bits/bit_mask.hpp"
#include "fields/tile_record.hpp"
#include "samples/block_walk.hpp"
#include "samples/tile_blocks.hpp"

namespace hmlfc {

SparsePlane SparsePlane::read(const StreamView& stream, int level, ImagePos image, Plane plane) {
  SparsePlane sparse;
  const PlaneShape& shape = stream.geometry.plane(plane);
  sparse.block_size_ = stream.geometry.block_size();
  sparse.tiles_x_ = shape.tiles_x;
  sparse.tiles_.reserve(static_cast<size_t>(shape.tiles()));
  for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
    for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
      const BlockSite site{level, image.row, image.col, plane, tx * kTileBlocks, ty * kTileBlocks};
      sparse.read_tile(stream, site);
    }
  }
  sparse.values_.shrink_to_fit();
  return sparse;
}

void SparsePlane::read_tile(const StreamView& stream, const BlockSite& site) {
  const size_t block_samples = size_t{block_size_} * block_size_;
  Tile tile;
  tile.first_block = static_cast<uint32_t>(values_.size() / block_samples);
  tile.first_error = static_cast<uint32_t>(errors_.size());
  TileBlocks blocks;
  if (const auto read = read_tile_blocks(stream, site, ~uint64_t{0}, blocks); read) {
    tile.coded = blocks.residual_mask;
    for (unsigned k = 0; k < kTileBlocks * kTileBlocks; ++k) {
      if (!has_bit(tile.coded, k)) continue;
      const int16_t* values = blocks.residual(k);
      values_.insert(values_.end(), values, values + block_samples);
    }
  } else {
    // Some block of the tile is damaged: ask for each alone.
    const uint64_t inside = tile_context(stream, site).blocks_inside;
    for (unsigned k = 0; k < kTileBlocks * kTileBlocks; ++k) {
      if (!has_bit(inside, k)) continue;
      BlockSite at = site;
      at.bx += block_column(k);
      at.by += block_row(k);
      const auto coded = walk_to_block(stream, Probe{nullptr, nullptr, at});
      if (!coded) {
        tile.failed |= uint64_t{1} << k;
        errors_.push_back(coded.error());
      } else if (coded->entry.has_residual()) {
        tile.coded |= uint64_t{1} << k;
        for (const int32_t value : coded->residual.span()) {
          values_.push_back(static_cast<int16_t>(value));
        }
      }
    }
  }
  tiles_.push_back(tile);
}

Result<const int16_t*> SparsePlane::find(uint32_t bx, uint32_t by) const {
  const Tile& tile = tiles_[size_t{by / kTileBlocks} * tiles_x_ + bx / kTileBlocks];
  const unsigned k = block_number(bx % kTileBlocks, by % kTileBlocks);
  if (has_bit(tile.failed, k)) {
    return tl::unexpected(errors_[tile.first_error + rank(tile.failed, k)]);
  }
  if (!has_bit(tile.coded, k)) return nullptr;
  const size_t block = size_t{tile.first_block} + rank(tile.coded, k);
  return values_.data() + block * block_size_ * block_size_;
}

size_t SparsePlane::bytes() const {
  return tiles_.capacity() * sizeof(Tile) + values_.capacity() * sizeof(int16_t) +
         errors_.capacity() * sizeof(Error);
}

Result<std::shared_ptr<const SparsePlane>> SparseReferences::plane(int level, ImagePos image,
                                                                   Plane plane) const {
  const uint64_t key =
      stream_.geometry.image_number(level, image) * kPlaneCount + static_cast<uint64_t>(plane);
  return planes_.get(key, [&]() -> Result<SparsePlane> {
    return SparsePlane::read(stream_, level, image, plane);
  });
}

Result<std::shared_ptr<const DisparityPlane>> SparseReferences::disparities(
    int level, ImagePos image, size_t motion_plane) const {
  const uint64_t key =
      stream_.geometry.image_number(level, image) * stream_.geometry.motion_planes().size() +
      motion_plane;
  return disparities_.get(key, [&]() -> Result<DisparityPlane> {
    return DisparityPlane::read(stream_, level, image, motion_plane);
  });
}

size_t SparseReferences::bytes() const {
  size_t total = 0;
  planes_.for_each([&](const SparsePlane& plane) { total += plane.bytes(); });
  disparities_.for_each([&](const DisparityPlane& plane) { total += plane.bytes(); });
  return total;
}

Result<BlockValues> SparseReference::block(uint32_t bx, uint32_t by) {
  const auto found = plane_.find(bx, by);
  if (!found) return tl::unexpected(found.error());
  BlockValues values(plane_.block_size());
  if (*found != nullptr) {
    for (size_t i = 0; i < values.size(); ++i) values[i] = (*found)[i];
  }
  return values;
}

}  // namespace hmlfc
