// The fast reader of disparities against one read for each grid block, on sound and on damaged
// records (MOT-6).
#include "decoder/fast/motion_field.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "decoder/naive_stream.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::DisparityModel;
using test::NaiveTile;
using test::NaiveTree;

StreamHeader draw_header(std::mt19937& random) {
  StreamHeader header =
      test::draw_extended_header(random, 2 + 8 + (test::draw(random, 0, 1) != 0 ? 32u : 0u));
  header.rows = header.cols = 1;
  header.width = static_cast<uint32_t>(test::draw(random, 1, 200));
  header.height = static_cast<uint32_t>(test::draw(random, 1, 200));
  header.tree_height = 0;
  header.levels = {{1, 1, 0}};
  return header;
}

// Values that reach past the interval, or a record with one thing wrong.
Bytes draw_record(std::mt19937& random, const DisparityModel& sound, int fault) {
  DisparityModel tile = sound;
  if (fault == 1) {
    tile.least = 4095 - test::draw(random, 0, 30);
    tile.code = 12;
    for (uint32_t& value : tile.values) value = static_cast<uint32_t>(test::draw(random, 0, 31));
  }
  Bytes bytes = test::write_disparities(tile).bytes();
  if (fault == 2) bytes.resize(1 + random() % bytes.size());
  if (fault == 3) bytes[2] = static_cast<uint8_t>(bytes[2] ^ (1u << random() % 2));
  return bytes;
}

/// What read_disparity says about a grid block of the plane.
std::optional<int32_t> read_one(const StreamView& stream, size_t motion_plane, GridBlock block) {
  const uint32_t per_tile =
      1u << (stream.header.motion_tile_log2 - stream.header.disparity_grid_log2);
  const MotionTilePlace place{0, {0, 0}, motion_plane, block.gx / per_tile, block.gy / per_tile};
  const auto record = find_motion_record(stream, place, Probe{});
  if (!record) return std::nullopt;
  if (!*record) return 0;
  FieldCursor cursor((*record)->bits, (*record)->file_bit, Probe{});
  const DisparityContext context = disparity_context(stream, place);
  const auto head = read_disparity_head(cursor, context);
  if (!head) return std::nullopt;
  const auto value =
      read_disparity(cursor, *head, context, block.gx % per_tile, block.gy % per_tile);
  if (!value) return std::nullopt;
  return *value;
}

TEST(DisparityPlane, EqualsOneReadForEachGridBlock) {
  std::mt19937 random(1);
  int readable = 0;
  int damaged = 0;
  for (int round = 0; round < 150; ++round) {
    const StreamHeader drawn = draw_header(random);
    const NaiveTree tree(drawn);
    std::map<uint64_t, Bytes> records;
    const uint32_t tile_side = 1u << drawn.motion_tile_log2;
    for (const NaiveTile& tile : tree.tiles()) {
      if (tile.plane != test::kMotionOfY && tile.plane != test::kMotionOfChroma) continue;
      if (test::draw(random, 0, 4) == 0) continue;
      const auto size = tree.plane_size(tile.plane);
      const DisparityModel sound = test::draw_disparity_tile(
          random, std::min(tile_side, size.width - tile.tx * tile_side),
          std::min(tile_side, size.height - tile.ty * tile_side), 1u << drawn.disparity_grid_log2);
      records[tree.tile_number(tile)] = draw_record(random, sound, test::draw(random, 0, 3));
    }
    const Bytes file = test::naive_file(drawn, test::naive_index(records, tree.tiles().size()));
    const StreamHeader header = parse_header(file).value();
    const StreamView stream{file, header, Geometry(header)};
    for (size_t m = 0; m < stream.geometry.motion_planes().size(); ++m) {
      const MotionPlaneShape& shape = stream.geometry.motion_planes()[m];
      const DisparityPlane plane(stream, 0, {0, 0}, m);
      const uint32_t grid = 1u << header.disparity_grid_log2;
      for (uint32_t gy = 0; gy * grid < shape.height; ++gy) {
        for (uint32_t gx = 0; gx * grid < shape.width; ++gx) {
          const auto expected = read_one(stream, m, {gx, gy});
          ASSERT_EQ(plane.find({gx, gy}), expected) << gx << ", " << gy << " of round " << round;
          ++(expected ? readable : damaged);
        }
      }
    }
  }
  EXPECT_GT(readable, 10000);
  EXPECT_GT(damaged, 1000);
}

}  // namespace
}  // namespace hmlfc
