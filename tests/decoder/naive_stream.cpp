#include "decoder/naive_stream.hpp"

#include <algorithm>

#include "arithmetic/naive_bise.hpp"
#include "arithmetic/naive_integers.hpp"
#include "bits/naive_bits.hpp"
#include "bits/naive_crc32c.hpp"
#include "decoder/jpeg2000.hpp"

namespace hmlfc::test {
namespace {

// STR-7.
int64_t most_of(int depth) { return (int64_t{1} << depth) - 1; }
int64_t least_of(Plane plane, int depth) { return plane == Plane::kY ? 0 : -most_of(depth); }

void put_group(const std::vector<const Bytes*>& lanes, NaiveBits& groups, NaiveBits& tiles) {
  std::vector<uint64_t> ends;
  uint64_t mask = 0;
  uint64_t end = 0;
  for (size_t lane = 0; lane < lanes.size(); ++lane) {
    if (lanes[lane] == nullptr) continue;
    mask |= uint64_t{1} << lane;
    end += lanes[lane]->size();
    ends.push_back(end);
  }
  unsigned offset_bits = 1;
  while ((end >> offset_bits) != 0) ++offset_bits;
  groups.put(mask, 64).put(tiles.size() / 8, 48).put(offset_bits, 8).put(0, 8);
  for (const uint64_t e : ends) tiles.put(e, offset_bits);
  while (tiles.size() % 8 != 0) tiles.put(0, 1);
  for (const Bytes* bytes : lanes) {
    if (bytes != nullptr) tiles.put(NaiveBits(*bytes));
  }
}

}  // namespace

SectionBytes naive_index(const std::map<uint64_t, Bytes>& tiles, uint64_t count) {
  NaiveBits root, groups, records;
  for (uint64_t first = 0; first < count; first += 4096) {
    const uint64_t first_record = groups.size() / 128;
    uint64_t mask = 0;
    for (uint64_t g = 0; g < 64; ++g) {
      std::vector<const Bytes*> lanes(64);
      bool any = false;
      for (uint64_t lane = 0; lane < 64; ++lane) {
        const auto found = tiles.find(first + 64 * g + lane);
        if (found == tiles.end()) continue;
        lanes[lane] = &found->second;
        any = true;
      }
      if (!any) continue;
      mask |= uint64_t{1} << g;
      put_group(lanes, groups, records);
    }
    root.put(mask, 64).put(first_record, 64);
  }
  return {Bytes{}, root.bytes(), groups.bytes(), records.bytes()};
}

Bytes naive_top(const std::vector<std::pair<Bytes, uint32_t>>& codestreams) {
  NaiveBits bits;
  uint64_t offset = 16 * codestreams.size();
  for (const auto& [bytes, crc] : codestreams) {
    bits.put(offset, 64).put(bytes.size(), 32).put(crc, 32);
    offset += bytes.size();
  }
  for (const auto& [bytes, crc] : codestreams) bits.put(NaiveBits(bytes));
  return bits.bytes();
}

uint32_t naive_sample_crc(const SamplePlane& plane) {
  NaiveBits bits;
  for (uint32_t y = 0; y < plane.height; ++y) {
    for (uint32_t x = 0; x < plane.width; ++x) bits.put_signed(plane.at(x, y), 16);
  }
  return naive_crc32c(bits.bytes());
}

NaiveStream::NaiveStream(std::mt19937& random, const StreamHeader& header, int density)
    : header_(header), tree_(header) {
  draw_keys(random);
  draw_tiles(random, density);
  draw_motion_tiles(random, density);
}

void NaiveStream::draw_keys(std::mt19937& random) {
  for (const NaiveImage& key : tree_.keys()) {
    for (const Plane plane : kPlanes) {
      const NaiveSize size = tree_.plane_size(plane);
      SamplePlane samples(size.width, size.height);
      const auto hi = static_cast<int>(most_of(header_.depth));
      const auto lo = static_cast<int>(least_of(plane, header_.depth));
      for (int16_t& sample : samples.samples) sample = static_cast<int16_t>(draw(random, lo, hi));
      keys_[{key, plane}] = samples;
    }
  }
}

TileContext NaiveStream::context_of(const NaiveTile& tile) const {
  TileContext context;
  context.predictive =
      tree_.reference(tile.image) != tile.image && !header_.has(Feature::kMotionTiles);
  context.steps = header_.has(Feature::kResidualStep);
  context.window = header_.window;
  context.depth = header_.depth;
  context.block_samples = uint64_t{1} << (2 * header_.block_log2);
  context.blocks_inside = 0;
  const NaiveSize blocks = tree_.plane_blocks(tile.plane);
  for (unsigned k = 0; k < 64; ++k) {
    const bool inside =
        8 * tile.tx + block_column(k) < blocks.width && 8 * tile.ty + block_row(k) < blocks.height;
    context.blocks_inside |= uint64_t{inside} << k;
  }
  return context;
}

void NaiveStream::draw_tiles(std::mt19937& random, int density) {
  for (const NaiveTile& tile : tree_.tiles()) {
    if (tile.plane == kMotionOfY || tile.plane == kMotionOfChroma) continue;
    if (tree_.is_key(tile.image) || draw(random, 1, 4) > density) continue;
    tiles_[tile] = draw_tile(random, context_of(tile));
  }
}

Bytes NaiveStream::file() const {
  std::map<uint64_t, Bytes> records;
  for (const auto& [tile, model] : motion_) {
    records[tree_.tile_number(tile)] = write_motion(model).bytes();
  }
  for (const auto& [tile, model] : disparities_) {
    records[tree_.tile_number(tile)] = write_disparities(model).bytes();
  }
  for (const auto& [tile, model] : tiles_) {
    records[tree_.tile_number(tile)] = write_tile(model).bits.bytes();
  }
  for (const auto& [tile, bytes] : replaced_) records[tree_.tile_number(tile)] = bytes;
  SectionBytes sections = naive_index(records, tree_.tiles().size());
  std::vector<std::pair<Bytes, uint32_t>> codestreams;
  for (const NaiveImage& key : tree_.keys()) {
    for (const Plane plane : kPlanes) {
      const SamplePlane& samples = keys_.at({key, plane});
      const bool chroma = plane != Plane::kY;
      const SamplePrecision precision{header_.depth + (chroma ? 1 : 0), chroma};
      codestreams.emplace_back(encode_jpeg2000(samples, precision).value(),
                               naive_sample_crc(samples));
    }
  }
  sections[0] = naive_top(codestreams);
  return naive_file(header_, sections);
}

const BlockModel* NaiveStream::block_at(const NaiveImage& image, Plane plane, uint32_t x,
                                        uint32_t y) const {
  const uint32_t bx = x >> header_.block_log2;
  const uint32_t by = y >> header_.block_log2;
  const auto tile = tiles_.find({image, plane, bx / 8, by / 8});
  if (tile == tiles_.end()) return nullptr;
  return &tile->second.blocks[block_number(bx % 8, by % 8)];
}

int64_t NaiveStream::residual(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const {
  const BlockModel* block = block_at(image, plane, x, y);
  if (block == nullptr || !block->residual) return 0;
  const uint32_t side = uint32_t{1} << header_.block_log2;
  const int64_t value = block->values[(y % side) * side + x % side];
  const int64_t levels = naive_level_counts()[block->level_code];
  const int64_t bound = most_of(header_.depth) - least_of(plane, header_.depth);
  const int64_t steps[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256};
  const int64_t coded = between(-bound, value - levels / 2 + block->bias, bound);
  return between(-bound, steps[block->step_code] * coded, bound);
}

int64_t NaiveStream::reference(const NaiveImage& from, Plane plane, int64_t x, int64_t y) const {
  const NaiveSize size = tree_.plane_size(plane);
  const auto cx = static_cast<uint32_t>(between(0, x, int64_t{size.width} - 1));
  const auto cy = static_cast<uint32_t>(between(0, y, int64_t{size.height} - 1));
  if (tree_.is_key(from)) return keys_.at({from, plane}).at(cx, cy);
  return residual(from, plane, cx, cy);
}

int64_t NaiveStream::parent_sample(const NaiveImage& image, Plane plane, uint32_t x,
                                   uint32_t y) const {
  if (image.level == header_.tree_height) return 0;
  return sample(tree_.parent(image), plane, x, y);
}

int64_t NaiveStream::displaced(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const {
  const auto [negative, references] = motion(image, plane, x, y);
  if (!header_.has(Feature::kMotionTiles)) {
    return reference(references[0].image, plane, x + references[0].vx, y + references[0].vy);
  }
  int64_t sum = 0;
  for (const NaiveReference& from : references) sum += interpolated(from, plane, x, y);
  return references.size() == 1 ? floor_of(sum + 32, 64) : floor_of(sum + 64, 128);
}

int64_t NaiveStream::prediction(const NaiveImage& image, Plane plane, uint32_t x,
                                uint32_t y) const {
  const NaiveMotion how = motion(image, plane, x, y);
  if (how.references.empty()) return parent_sample(image, plane, x, y);
  const bool keyed = tree_.is_key(tree_.reference(image));
  const int64_t base = keyed ? 0 : parent_sample(image, plane, x, y);
  const int64_t ref = displaced(image, plane, x, y);
  return between(least_of(plane, header_.depth), how.negative ? base - ref : base + ref,
                 most_of(header_.depth));
}

int64_t NaiveStream::sample(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const {
  if (tree_.is_key(image)) return keys_.at({image, plane}).at(x, y);
  return between(least_of(plane, header_.depth),
                 prediction(image, plane, x, y) + residual(image, plane, x, y),
                 most_of(header_.depth));
}

StreamHeader draw_stream_header(std::mt19937& random) {
  const auto number = [&](int lo, int hi) { return static_cast<uint32_t>(draw(random, lo, hi)); };
  StreamHeader header;
  header.rows = number(1, 6);
  header.cols = number(1, 6);
  header.width = number(1, 75);
  header.height = number(1, 75);
  header.depth = draw(random, 8, 12);
  header.chroma_format = draw(random, 0, 1) != 0 ? ChromaFormat::k444 : ChromaFormat::k420;
  header.block_log2 = number(1, 3);
  header.window = draw(random, 0, 1) != 0 ? draw(random, 0, 127) : draw(random, 0, 12);
  header.tree_height = draw(random, 0, 3);
  header.cluster_rows = number(1, 3);
  header.cluster_cols = number(header.cluster_rows == 1 ? 2 : 1, 3);
  for (int level = 0; level <= header.tree_height; ++level) {
    header.levels.push_back(
        {static_cast<uint8_t>(draw(random, 1, 4)), static_cast<uint8_t>(draw(random, 1, 4))});
  }
  return header;
}

BlockAddress draw_block(std::mt19937& random, const NaiveStream& stream) {
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  const Plane plane = kPlanes[random() % 3];
  const NaiveSize blocks = stream.tree().plane_blocks(plane);
  return {{below(stream.header().rows), below(stream.header().cols)},
          plane,
          below(blocks.width),
          below(blocks.height)};
}

}  // namespace hmlfc::test
