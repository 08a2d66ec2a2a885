// Reading a reference at any place: the definition in one line, the golden path and the fast one
// (DEC-4, DEC-5).
#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "arithmetic/naive_integers.hpp"
#include "decoder/fast/reference_reader.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/golden/block_walk.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::between;

/// A plane whose sample (x, y) is 100 * y + x, and poison outside.
class PlaneOfNumbers {
 public:
  PlaneOfNumbers(const PlaneShape& shape, unsigned block_size)
      : shape_(shape), block_size_(block_size) {}

  Result<BlockValues> block(uint32_t bx, uint32_t by) {
    EXPECT_LT(bx, shape_.blocks_x);
    EXPECT_LT(by, shape_.blocks_y);
    const std::pair<uint32_t, uint32_t> place{by, bx};
    EXPECT_TRUE(asked_.empty() || *asked_.rbegin() < place) << "row by row, each once (DEC-7)";
    asked_.insert(place);
    BlockValues values(block_size_);
    for (unsigned j = 0; j < block_size_; ++j) {
      for (unsigned i = 0; i < block_size_; ++i) {
        const uint32_t x = bx * block_size_ + i;
        const uint32_t y = by * block_size_ + j;
        const bool inside = x < shape_.width && y < shape_.height;
        values.at(i, j) = inside ? static_cast<int32_t>(100 * y + x) : -12345;
      }
    }
    return values;
  }

  size_t asked() const { return asked_.size(); }

 private:
  PlaneShape shape_;
  unsigned block_size_;
  std::set<std::pair<uint32_t, uint32_t>> asked_;
};

PlaneShape shape_of(uint32_t width, uint32_t height, unsigned block_size) {
  PlaneShape shape;
  shape.width = width;
  shape.height = height;
  shape.blocks_x = (width + block_size - 1) / block_size;
  shape.blocks_y = (height + block_size - 1) / block_size;
  return shape;
}

// A window of size + more columns and rows: more is 1 between samples.
void check_gather(uint32_t width, uint32_t height, unsigned size, int32_t x, int32_t y,
                  unsigned more) {
  const PlaneShape shape = shape_of(width, height, size);
  PlaneOfNumbers blocks(shape, size);
  const auto read_block = [&](uint32_t bx, uint32_t by) { return blocks.block(bx, by); };
  const auto gathered = gather_reference(read_block, shape, size, {x, y, size + more, size});
  ASSERT_TRUE(gathered.has_value());
  ASSERT_EQ(gathered->columns(), size + more);
  ASSERT_EQ(gathered->rows(), size);
  EXPECT_LE(blocks.asked(), 4u) << "at most 2 x 2 blocks";
  for (unsigned j = 0; j < size; ++j) {
    for (unsigned i = 0; i < size + more; ++i) {
      ASSERT_EQ(gathered->at(i, j), 100 * between(0, int64_t{y} + j, int64_t{height} - 1) +
                                        between(0, int64_t{x} + i, int64_t{width} - 1))
          << width << "x" << height << ", block of " << size << " at " << x << ", " << y;
    }
  }
}

TEST(GatherReference, EveryPlaceAroundSmallPlanes) {
  for (const unsigned size : {2u, 4u, 8u}) {
    for (const uint32_t width : {1u, 2u, 5u, 8u, 19u}) {
      for (const uint32_t height : {1u, 3u, 8u, 12u}) {
        for (int32_t y = -20; y <= 32; ++y) {
          for (int32_t x = -20; x <= 40; ++x) {
            check_gather(width, height, size, x, y, 0);
            check_gather(width, height, size, x, y, 1);
          }
        }
      }
    }
  }
}

RC_GTEST_PROP(GatherReference, FarOutside, ()) {
  const uint32_t width = *rc::gen::inRange(1u, 100u);
  const uint32_t height = *rc::gen::inRange(1u, 100u);
  const unsigned size = 2u << *rc::gen::inRange(0, 3);
  const int32_t x = *rc::gen::inRange(-70000, 70000);
  const int32_t y = *rc::gen::inRange(-70000, 70000);
  check_gather(width, height, size, x, y, *rc::gen::inRange(0u, 2u));
}

TEST(GatherReference, FailsIfAndOnlyIfABlockItReadsFails) {
  const auto blocks = [](uint32_t bx, uint32_t by) -> Result<BlockValues> {
    if (bx == 1 && by == 2) return fail(ErrorCode::kTileOverrun, Section::kTile, 99);
    return BlockValues(4);
  };
  const PlaneShape shape = shape_of(16, 16, 4);
  for (int32_t y = -8; y <= 24; ++y) {
    for (int32_t x = -8; x <= 24; ++x) {
      bool reads = false;
      for (int32_t j = 0; j < 4; ++j) {
        for (int32_t i = 0; i < 4; ++i) {
          reads = reads || (between(0, x + i, 15) / 4 == 1 && between(0, y + j, 15) / 4 == 2);
        }
      }
      const auto gathered = gather_reference(blocks, shape, 4, {x, y, 4, 4});
      ASSERT_EQ(gathered.has_value(), !reads) << x << ", " << y;
      if (reads) {
        EXPECT_EQ(gathered.error().offset, 99u);
      }
    }
  }
}

/// ref(x, y) of DEC-4 and DEC-5, from the golden path's blocks.
int32_t value_at(const FastSources& sources, int level, ImagePos from, Plane plane, int64_t x,
                 int64_t y) {
  const Geometry& geometry = sources.stream.geometry;
  const PlaneShape& shape = geometry.plane(plane);
  const auto cx = static_cast<uint32_t>(between(0, x, int64_t{shape.width} - 1));
  const auto cy = static_cast<uint32_t>(between(0, y, int64_t{shape.height} - 1));
  if (geometry.is_key(level, from)) {
    return sources.keys.plane(level, from, plane).value()->at(cx, cy);
  }
  const unsigned side = geometry.block_size();
  const Probe probe{nullptr, nullptr, {level, from.row, from.col, plane, cx / side, cy / side}};
  return walk_to_block(sources.stream, probe).value().residual.at(cx % side, cy % side);
}

// At every level, of a predictive image, all planes: key images, sparse residuals, empty tiles.
void check_reader(std::mt19937& random, const test::Bytes& file) {
  const StreamHeader header = parse_header(file).value();
  const StreamView stream{file, header, Geometry(header)};
  const KeyImages keys(stream);
  const SparseReferences references(stream);
  const FastSources sources{stream, keys, references};
  for (int round = 0; round < 12; ++round) {
    const int level = test::draw(random, 0, header.tree_height);
    const LevelShape& images = stream.geometry.level(level);
    const Plane plane = kPlanes[random() % 3];
    const ImagePos from =
        stream.geometry.reference_of(level, {static_cast<uint32_t>(random() % images.rows),
                                             static_cast<uint32_t>(random() % images.cols)});
    const auto reader = ReferenceReader::open(sources, level, from, plane);
    ASSERT_TRUE(reader.has_value()) << to_string(reader.error());
    const auto size = static_cast<int32_t>(header.block_size());
    const auto w = static_cast<int32_t>(stream.geometry.plane(plane).width);
    const auto h = static_cast<int32_t>(stream.geometry.plane(plane).height);
    for (int i = 0; i < 30; ++i) {
      const bool far = i % 6 == 0;
      const int32_t x = test::draw(random, far ? -200 : -size, far ? w + 200 : w);
      const int32_t y = test::draw(random, far ? -200 : -size, far ? h + 200 : h);
      const auto columns = static_cast<unsigned>(test::draw(random, 1, i % 3 == 0 ? 33 : size + 1));
      const auto rows = static_cast<unsigned>(test::draw(random, 1, i % 3 == 0 ? 33 : size + 1));
      std::vector<int16_t> buffer(size_t{columns} * rows, -31000);
      const auto read = reader->view({x, y, columns, rows}, buffer.data());
      ASSERT_TRUE(read.has_value()) << to_string(read.error());
      for (unsigned j = 0; j < rows; ++j) {
        for (unsigned k = 0; k < columns; ++k) {
          ASSERT_EQ(read->data[j * read->stride + k],
                    value_at(sources, level, from, plane, x + int64_t{k}, y + int64_t{j}))
              << "level " << level << " at " << x << ", " << y << ", value " << k << ", " << j;
        }
      }
    }
  }
}

TEST(ReferenceReader, ReadsWhatTheGoldenPathReads) {
  std::mt19937 random(1);
  for (uint64_t seed = 0; seed < 25; ++seed) {
    const test::Bytes file = vectors::random_stream(seed, {});
    ASSERT_NO_FATAL_FAILURE(check_reader(random, file)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hmlfc
