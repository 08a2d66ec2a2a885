#include "decoder/fast/part_loader.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <unordered_set>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "decoder/fast/tile_blocks.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/missing_ranges.hpp"
#include "syntax/index.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

// Blocks of one tile.
struct WantedTile {
  uint64_t number;  // IDX-2
  BlockSite site;   // its first block
  uint64_t blocks;  // by block number (TIL-2)
};

// The tiles that hold `parts`, each once. Key images have none.
std::vector<WantedTile> tiles_of(const Geometry& geometry, std::span<const ImagePart> parts) {
  std::vector<WantedTile> tiles;
  for (const ImagePart& part : parts) {
    if (geometry.is_key(part.level, part.image)) continue;
    const uint64_t image = geometry.image_number(part.level, part.image);
    for (uint32_t ty = part.rect.by0 / kTileBlocks; ty * kTileBlocks < part.rect.by1; ++ty) {
      for (uint32_t tx = part.rect.bx0 / kTileBlocks; tx * kTileBlocks < part.rect.bx1; ++tx) {
        const BlockSite site{part.level, part.image.row,   part.image.col,
                             part.plane, tx * kTileBlocks, ty * kTileBlocks};
        tiles.push_back({geometry.tile_number(image, part.plane, tx, ty), site,
                         blocks_of_rect(part.rect, site.bx, site.by)});
      }
    }
  }
  std::ranges::sort(tiles, {}, &WantedTile::number);
  size_t kept = 0;
  for (const WantedTile& tile : tiles) {
    if (kept > 0 && tiles[kept - 1].number == tile.number) {
      tiles[kept - 1].blocks |= tile.blocks;
    } else {
      tiles[kept++] = tile;
    }
  }
  tiles.resize(kept);
  return tiles;
}

// One round: walks as far as the bytes that are there lead.
class Round {
 public:
  /// Null for `keys`: without key images.
  Round(const KeyImages* keys, const StreamView& stream, const MissingRanges& missing)
      : keys_(keys),
        stream_(stream),
        geometry_(stream.geometry),
        missing_(missing),
        references_(stream),
        entries_(stream) {}

  void visit_key(int level, ImagePos image, Plane plane) {
    if (keys_ == nullptr) return;
    const uint64_t number =
        geometry_.key_number(level, image) * kPlaneCount + static_cast<uint64_t>(plane);
    if (keys_seen_.insert(number).second) keys_->load(stream_, level, image, plane);
  }

  // Returns whether all is there that the blocks of the tile need.
  bool visit(const WantedTile& tile) {
    const size_t missed = missing_.count();
    complete_ = true;
    const ImagePos image{tile.site.image_row, tile.site.image_col};
    if (stream_.header.has(Feature::kMotionTiles) &&
        !geometry_.is_reference(tile.site.level, image)) {
      visit_motion(tile);
    }
    if (read_tile_blocks(stream_, tile.site, 0, *blocks_)) visit_vectors(tile);
    return complete_ && missing_.count() == missed;
  }

 private:
  template <class Visit>
  static void for_each_block(const BlockSite& first, uint64_t blocks, const Visit& visit) {
    for (uint64_t left = blocks; left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(left));
      BlockSite site = first;
      site.bx += block_column(k);
      site.by += block_row(k);
      visit(site, k);
    }
  }

  // The references of the tile's own vectors.
  void visit_vectors(const WantedTile& tile) {
    const auto& [level, row, col, plane, bx, by, kind] = tile.site;
    const ImagePos reference = geometry_.reference_of(level, {row, col});
    for_each_block(tile.site, tile.blocks & blocks_->motion_mask,
                   [&](const BlockSite& site, unsigned k) {
                     visit_reference(site, reference, {blocks_->dx[k], blocks_->dy[k], 0, 0});
                   });
  }

  // The references of a tile in a stream with motion tiles.
  void visit_motion(const WantedTile& tile) {
    const ImagePos image{tile.site.image_row, tile.site.image_col};
    const MotionResolver resolver(stream_, tile.site.level, image, tile.site.plane);
    for_each_block(tile.site, tile.blocks, [&](const BlockSite& site, unsigned) {
      const MotionPlace place = motion_place(stream_, site);
      const auto found_entry = entries_.find(site);
      const PaletteEntry* entry = found_entry ? *found_entry : nullptr;
      if (entry == nullptr || !entry->has_motion()) return;
      int32_t disparity = 0;
      if (entry->shares_disparity()) {
        const auto found =
            references_.disparities(site.level, resolver.images()[0], place.motion_plane)
                ->find(grid_block(place.x, place.y, entry->choice,
                                  stream_.header.disparity_grid_log2,
                                  geometry_.motion_planes()[place.motion_plane]));
        // Whether it is missing or damaged is not told apart: the next round asks again.
        if (!found) complete_ = false;
        if (!found) return;
        disparity = *found;
      }
      const BlockMotion motion = resolver.resolve(*entry, disparity);
      for (unsigned i = 0; i < motion.count; ++i) {
        visit_reference(site, motion.references[i].image, motion.references[i].vector);
      }
    });
  }

  // The tiles of reference image `image` that hold the displaced block `site`.
  void visit_reference(const BlockSite& site, ImagePos image, const SubpelVector& vector) {
    if (geometry_.level(site.level).keyed) return visit_key(site.level, image, site.plane);
    const PlaneShape& plane = geometry_.plane(site.plane);
    const auto tile_of = [&](uint32_t block, int32_t offset, unsigned more, uint32_t size) {
      const auto side = static_cast<int32_t>(geometry_.block_size());
      const int32_t at = static_cast<int32_t>(block) * side + offset + static_cast<int32_t>(more);
      return static_cast<uint32_t>(clamp(at, 0, static_cast<int32_t>(size) - 1)) /
             (geometry_.block_size() * kTileBlocks);
    };
    const unsigned last = geometry_.block_size() - 1;
    const unsigned last_x = last + (vector.fx == 0 ? 0 : 1);
    const unsigned last_y = last + (vector.fy == 0 ? 0 : 1);
    const uint32_t tx1 = tile_of(site.bx, vector.ix, last_x, plane.width);
    const uint32_t ty1 = tile_of(site.by, vector.iy, last_y, plane.height);
    for (uint32_t ty = tile_of(site.by, vector.iy, 0, plane.height); ty <= ty1; ++ty) {
      for (uint32_t tx = tile_of(site.bx, vector.ix, 0, plane.width); tx <= tx1; ++tx) {
        const BlockSite at{site.level, image.row,        image.col,
                           site.plane, tx * kTileBlocks, ty * kTileBlocks};
        const uint64_t number =
            geometry_.tile_number(geometry_.image_number(site.level, image), site.plane, tx, ty);
        if (tiles_seen_.insert(number).second) static_cast<void>(find_record(stream_, at, {}));
      }
    }
  }

  const KeyImages* keys_;
  const StreamView& stream_;
  const Geometry& geometry_;
  const MissingRanges& missing_;
  SparseReferences references_;  // disparities as this round finds them
  std::unordered_set<uint64_t> keys_seen_;
  std::unordered_set<uint64_t> tiles_seen_;  // of reference images; the first to ask comes again
  std::unique_ptr<TileBlocks> blocks_ = std::make_unique<TileBlocks>();
  MotionEntries entries_;
  bool complete_ = true;
};

}  // namespace

void add_with_ancestors(const Geometry& geometry, ImagePart part, std::vector<ImagePart>& parts) {
  const ImagePos own = part.image;
  const int from = part.level;
  for (int level = first_level(geometry, from, own); level >= from; --level) {
    part.level = level;
    part.image = geometry.ancestor(own, from, level);
    parts.push_back(part);
  }
}

void load_parts(const FastSources& sources, std::span<const ImagePart> parts, bool keys) {
  if (sources.stream.source == nullptr) return;
  const Geometry& geometry = sources.stream.geometry;
  std::vector<WantedTile> left = tiles_of(geometry, parts);
  StreamView stream = sources.stream;
  stream.reads = nullptr;
  load_by_trials(stream, [&](const StreamView& view, const MissingRanges& missing) {
    Round round(keys ? &sources.keys : nullptr, view, missing);
    for (const ImagePart& part : parts) {
      if (geometry.is_key(part.level, part.image)) {
        round.visit_key(part.level, part.image, part.plane);
      }
    }
    std::erase_if(left, [&](const WantedTile& tile) { return round.visit(tile); });
  });
}

void load_images(const FastSources& sources, int lowest, bool keys) {
  if (sources.stream.source == nullptr) return;
  const Geometry& geometry = sources.stream.geometry;
  std::vector<ImagePart> parts;
  for (int level = geometry.top(); level >= lowest; --level) {
    for (const ImagePos image : geometry.level(level).all_images()) {
      for (const Plane plane : kPlanes) {
        parts.push_back({level, image, plane, whole_plane(geometry.plane(plane))});
      }
    }
  }
  load_parts(sources, parts, keys);
}

}  // namespace hmlfc
