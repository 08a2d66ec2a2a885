#include "decoder/fast/sparse_plane.hpp"

#include <algorithm>
#include <bit>

#include "arithmetic/widths.hpp"
#include "bits/bit_string.hpp"
#include "decoder/fast/tile_blocks.hpp"
#include "decoder/golden/block_walk.hpp"
#include "syntax/index.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

SparsePlane::SparsePlane(const StreamView& stream, int level, ImagePos image, Plane plane)
    : stream_(stream),
      site_{level, image.row, image.col, plane},
      block_size_(stream.geometry.block_size()),
      tiles_x_(stream.geometry.plane(plane).tiles_x),
      tiles_(static_cast<size_t>(stream.geometry.plane(plane).tiles())),
      read_(tiles_.size()) {}

const SparsePlane::Tile& SparsePlane::tile_at(size_t number) const {
  read_.fill_once(number, [&] {
    BlockSite site = site_;
    site.bx = static_cast<uint32_t>(number % tiles_x_) * kTileBlocks;
    site.by = static_cast<uint32_t>(number / tiles_x_) * kTileBlocks;
    tiles_[number] = {};
    read_tile(site, tiles_[number]);
  });
  return tiles_[number];
}

void SparsePlane::read_tile(const BlockSite& site, Tile& tile) const {
  const size_t block_samples = size_t{block_size_} * block_size_;
  TileBlocks blocks;
  // Some block of a tile that cannot be read is damaged: each is read alone.
  if (!read_tile_blocks(stream_, site, ~uint64_t{0}, blocks)) return read_blocks(site, tile);
  tile.coded = blocks.residual_mask;
  tile.values.reserve(static_cast<size_t>(std::popcount(tile.coded)) * block_samples);
  for (unsigned k = 0; k < kTileBlocks * kTileBlocks; ++k) {
    if (!has_bit(tile.coded, k)) continue;
    const int16_t* values = blocks.residual(k);
    tile.values.insert(tile.values.end(), values, values + block_samples);
  }
}

void SparsePlane::read_blocks(const BlockSite& site, Tile& tile) const {
  const uint64_t inside = tile_context(stream_, site).blocks_inside;
  for (unsigned k = 0; k < kTileBlocks * kTileBlocks; ++k) {
    if (!has_bit(inside, k)) continue;
    BlockSite at = site;
    at.bx += block_column(k);
    at.by += block_row(k);
    const auto coded = walk_to_block(stream_, Probe{nullptr, nullptr, at});
    if (!coded) {
      tile.failed |= uint64_t{1} << k;
      tile.errors.push_back(coded.error());
    } else if (coded->entry.has_residual()) {
      tile.coded |= uint64_t{1} << k;
      for (const int32_t value : coded->residual.span()) {
        tile.values.push_back(narrow<int16_t>(value));
      }
    }
  }
}

Result<const int16_t*> SparsePlane::find(uint32_t bx, uint32_t by) const {
  const Tile& tile = tile_at(size_t{by / kTileBlocks} * tiles_x_ + bx / kTileBlocks);
  const unsigned k = block_number(bx % kTileBlocks, by % kTileBlocks);
  if (has_bit(tile.failed, k)) return tl::unexpected(tile.errors[rank(tile.failed, k)]);
  if (!has_bit(tile.coded, k)) return nullptr;
  return tile.values.data() + size_t{rank(tile.coded, k)} * block_size_ * block_size_;
}

void SparsePlane::read_all() const {
  for (size_t number = 0; number < tiles_.size(); ++number) tile_at(number);
}

size_t SparsePlane::bytes() const {
  const std::scoped_lock lock(read_.mutex());
  size_t total = tiles_.size() * sizeof(Tile);
  for (const Tile& tile : tiles_) {
    total += tile.values.capacity() * sizeof(int16_t) + tile.errors.capacity() * sizeof(Error);
  }
  return total;
}

std::shared_ptr<const SparsePlane> SparseReferences::plane(int level, ImagePos image,
                                                           Plane plane) const {
  const uint64_t key =
      stream_.geometry.image_number(level, image) * kPlaneCount + static_cast<uint64_t>(plane);
  const auto make = [&]() -> Result<std::shared_ptr<const SparsePlane>> {
    return std::make_shared<const SparsePlane>(stream_, level, image, plane);
  };
  return *planes_.get(key, make);
}

std::shared_ptr<const DisparityPlane> SparseReferences::disparities(int level, ImagePos image,
                                                                    size_t motion_plane) const {
  const uint64_t key =
      stream_.geometry.image_number(level, image) * stream_.geometry.motion_planes().size() +
      motion_plane;
  const auto make = [&]() -> Result<std::shared_ptr<const DisparityPlane>> {
    return std::make_shared<const DisparityPlane>(stream_, level, image, motion_plane);
  };
  return *disparities_.get(key, make);
}

Result<BlockValues> SparseReferences::block(const BlockSite& site) const {
  const auto held = plane(site.level, {site.image_row, site.image_col}, site.plane);
  const auto found = held->find(site.bx, site.by);
  if (!found) return tl::unexpected(found.error());
  BlockValues values(held->block_size());
  if (*found != nullptr) std::copy_n(*found, values.size(), &values[0]);
  return values;
}

size_t SparseReferences::bytes() const {
  size_t total = 0;
  planes_.for_each([&](const SparsePlane& plane) { total += plane.bytes(); });
  disparities_.for_each([&](const DisparityPlane& plane) { total += plane.bytes(); });
  return total;
}

}  // namespace hmlfc
