// What profile extended adds to NaiveStream.
#include <algorithm>

#include "arithmetic/naive_integers.hpp"
#include "decoder/naive_stream.hpp"

namespace hmlfc::test {

NaiveSize NaiveStream::motion_tile_size(const NaiveTile& tile) const {
  const NaiveSize plane = tree_.plane_size(tile.plane);
  const auto side = static_cast<uint32_t>(power_of_two(header_.motion_tile_log2));
  return {std::min(side, plane.width - tile.tx * side),
          std::min(side, plane.height - tile.ty * side)};
}

void NaiveStream::draw_motion_tiles(std::mt19937& random, int density) {
  MotionRules rules;
  rules.two_references = header_.has(Feature::kTwoReferences);
  rules.disparities = header_.has(Feature::kSharedDisparity);
  rules.least_block = header_.block_log2 == 3 ? 1 : 0;
  for (const NaiveTile& tile : tree_.tiles()) {
    if (tile.plane != kMotionOfY && tile.plane != kMotionOfChroma) continue;
    if (draw(random, 1, 5) > density) continue;
    const NaiveSize size = motion_tile_size(tile);
    if (tree_.reference(tile.image) != tile.image) {
      rules.signs = !tree_.is_key(tree_.reference(tile.image));
      motion_[tile] = draw_motion_tile(random, rules, size.width, size.height);
    } else if (rules.disparities) {
      const auto side = static_cast<uint32_t>(power_of_two(header_.disparity_grid_log2));
      disparities_[tile] = draw_disparity_tile(random, size.width, size.height, side);
    }
  }
}

bool NaiveStream::is_halved(Plane plane) const {
  return plane != Plane::kY && header_.chroma_format == ChromaFormat::k420 &&
         !header_.has(Feature::kChromaMotion);
}

// MOT-3 and the defaults of MOT-4.
EntryModel NaiveStream::entry_at(const NaiveTile& tile, uint32_t x, uint32_t y) const {
  const auto found = motion_.find(tile);
  if (found == motion_.end()) {
    EntryModel entry;
    entry.reference_set = header_.has(Feature::kTwoReferences) ? 1 : 0;
    if (tree_.is_key(tree_.reference(tile.image))) {
      entry.choice = header_.has(Feature::kSharedDisparity) ? 1 : 11;
    }
    return entry;
  }
  const MotionModel& model = found->second;
  return model.palette[model.indices[y / model.side() * model.columns + x / model.side()]];
}

// MOT-6; (gx, gy) may lie outside the grid.
int64_t NaiveStream::disparity_at(const NaiveImage& image, Plane motion_plane, int64_t gx,
                                  int64_t gy) const {
  const NaiveSize size = tree_.plane_size(motion_plane);
  const int64_t side = power_of_two(header_.disparity_grid_log2);
  const auto cx = static_cast<uint32_t>(between(0, gx, floor_of(int64_t{size.width} - 1, side)));
  const auto cy = static_cast<uint32_t>(between(0, gy, floor_of(int64_t{size.height} - 1, side)));
  const auto per_tile = static_cast<uint32_t>(power_of_two(header_.motion_tile_log2) / side);
  const auto found =
      disparities_.find({tree_.reference(image), motion_plane, cx / per_tile, cy / per_tile});
  return found == disparities_.end() ? 0 : found->second.at(cx % per_tile, cy % per_tile);
}

// MOT-4 to MOT-8 for the block that holds (x, y).
NaiveMotion NaiveStream::tile_motion(const NaiveImage& image, Plane plane, uint32_t x,
                                     uint32_t y) const {
  NaiveMotion motion;
  if (tree_.reference(image) == image) return motion;
  const auto block = static_cast<uint32_t>(power_of_two(header_.block_log2));
  const uint32_t scale = is_halved(plane) ? 2 : 1;
  const uint32_t px = x / block * block * scale;
  const uint32_t py = y / block * block * scale;
  const bool own_chroma = plane != Plane::kY && header_.has(Feature::kChromaMotion);
  const Plane motion_plane = own_chroma ? kMotionOfChroma : kMotionOfY;
  const auto side = static_cast<uint32_t>(power_of_two(header_.motion_tile_log2));
  const EntryModel entry =
      entry_at({image, motion_plane, px / side, py / side}, px % side, py % side);
  if (entry.choice == 0) return motion;
  motion.negative = entry.negative;

  int64_t d = entry.explicit_x;
  if (entry.choice < 10) {
    const int moves[10][2] = {{},     {0, 0},   {-1, 0}, {1, 0},  {0, -1},
                              {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const int64_t grid = power_of_two(header_.disparity_grid_log2);
    d = disparity_at(image, motion_plane, px / grid + moves[entry.choice][0],
                     py / grid + moves[entry.choice][1]);
  }
  const std::vector<size_t> sets[8] = {{0}, {0, 1}, {0, 2}, {1}, {2}, {1, 2}, {0, 3}, {3}};
  const int64_t most = header_.window * power_of_two(header_.vector_precision);
  const unsigned s = header_.disparity_precision - header_.vector_precision;
  for (const size_t k : sets[entry.reference_set]) {
    const NaiveImage from = tree_.references(image)[k];
    int64_t vx = entry.explicit_x;
    int64_t vy = entry.explicit_y;
    if (entry.choice != 11) {
      vx = rounded(d * (int64_t{from.col} - image.col), s);
      vy = rounded(d * header_.row_scale * (int64_t{from.row} - image.row), s + 4);
    }
    motion.references.push_back({from, between(-most, vx, most), between(-most, vy, most)});
  }
  return motion;
}

NaiveMotion NaiveStream::motion(const NaiveImage& image, Plane plane, uint32_t x,
                                uint32_t y) const {
  if (header_.has(Feature::kMotionTiles)) return tile_motion(image, plane, x, y);
  const BlockModel* block = block_at(image, plane, x, y);
  if (block == nullptr || !block->motion) return {};
  return {block->negative, {{tree_.reference(image), block->dx, block->dy}}};
}

// 64 times the value of `from` at (x, y) displaced: I of MOT-9.
int64_t NaiveStream::interpolated(const NaiveReference& from, Plane plane, int64_t x,
                                  int64_t y) const {
  const int64_t scale = power_of_two(3 - header_.vector_precision);
  const bool halved = is_halved(plane);
  const int64_t ux = halved ? rounded(from.vx * scale, 1) : from.vx * scale;
  const int64_t uy = halved ? rounded(from.vy * scale, 1) : from.vy * scale;
  const int64_t ix = floor_of(ux, 8);
  const int64_t iy = floor_of(uy, 8);
  const int64_t fx = ux - 8 * ix;
  const int64_t fy = uy - 8 * iy;
  const auto ref = [&](int64_t dx, int64_t dy) {
    return reference(from.image, plane, x + ix + dx, y + iy + dy);
  };
  return (8 - fy) * ((8 - fx) * ref(0, 0) + fx * ref(1, 0)) +
         fy * ((8 - fx) * ref(0, 1) + fx * ref(1, 1));
}

uint64_t NaiveStream::motion_bits() const {
  uint64_t bits = 0;
  for (const auto& [tile, model] : motion_) bits += write_motion(model).size();
  for (const auto& [tile, model] : disparities_) bits += write_disparities(model).size();
  for (const auto& [tile, model] : tiles_) {
    const TileRecord record = write_tile(model);
    bits += record.residuals_begin - record.vectors_begin;
  }
  return bits;
}

uint64_t NaiveStream::residual_bits() const {
  uint64_t bits = 0;
  for (const auto& [tile, model] : tiles_) {
    const TileRecord record = write_tile(model);
    bits += record.ends[63] - record.residuals_begin;
  }
  return bits;
}

std::array<uint64_t, 4> NaiveStream::states() const {
  std::array<uint64_t, 4> states{};
  const uint32_t side = header_.block_size();
  for (const NaiveImage& image : tree_.images()) {
    if (tree_.is_key(image)) continue;
    for (const Plane plane : kPlanes) {
      const NaiveSize size = tree_.plane_size(plane);
      for (uint32_t y = 0; y < size.height; y += side) {
        for (uint32_t x = 0; x < size.width; x += side) {
          const BlockModel* block = block_at(image, plane, x, y);
          const bool residual = block != nullptr && block->residual;
          const bool moves = !motion(image, plane, x, y).references.empty();
          ++states[moves ? (residual ? 2 : 1) : (residual ? 3 : 0)];
        }
      }
    }
  }
  return states;
}

uint32_t draw_flags(std::mt19937& random) {
  uint32_t flags = random() % 512;
  const uint32_t need_motion_tiles = 4 + 8 + 16 + 32;
  if ((flags & need_motion_tiles) != 0) flags |= 2;
  return flags;
}

StreamHeader draw_extended_header(std::mt19937& random, uint32_t flags) {
  StreamHeader header = draw_stream_header(random);
  header.profile = Profile::kExtended;
  header.feature_flags = flags;
  if (header.has(Feature::kSubpelVectors)) {
    header.vector_precision = static_cast<unsigned>(draw(random, 1, 3));
  }
  if (header.has(Feature::kMotionTiles)) {
    header.motion_tile_log2 = static_cast<unsigned>(draw(random, 5, 7));
  }
  if (header.has(Feature::kSharedDisparity)) {
    header.disparity_precision =
        static_cast<unsigned>(draw(random, static_cast<int>(header.vector_precision), 5));
    header.disparity_grid_log2 = static_cast<unsigned>(draw(random, 2, 5));
    header.row_scale = draw(random, -127, 127);
  }
  for (int level = 0; level < header.tree_height; ++level) {
    const bool keyed = header.has(Feature::kLevelKeys) && draw(random, 0, 1) != 0;
    header.levels[static_cast<size_t>(level)].key_references = keyed ? 1 : 0;
  }
  return header;
}

}  // namespace hmlfc::test
