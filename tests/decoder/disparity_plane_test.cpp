// The fast reader of disparities against one read for each grid block, on sound and on damaged
// records (MOT-6).
#include "decoder/fast/motion_field.hpp"

#include <cstdint>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "vectors/draw.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

StreamHeader draw_disparity_header(std::mt19937& random) {
  const auto number = [&](int lo, int hi) {
    return static_cast<uint32_t>(test::draw(random, lo, hi));
  };
  StreamHeader header = test::some_header(0);
  header.profile = Profile::kExtended;
  header.feature_flags =
      feature_bit(Feature::kMotionTiles) | feature_bit(Feature::kSharedDisparity);
  if (random() % 2 == 0) header.feature_flags |= feature_bit(Feature::kChromaMotion);
  header.rows = header.cols = 1;
  header.width = number(1, 200);
  header.height = number(1, 200);
  header.motion_tile_log2 = number(5, 7);
  header.disparity_grid_log2 = number(2, 5);
  header.levels = {{1, 1, 0}};
  return header;
}

// Sound, with values that reach past the interval, or with one thing wrong.
Bytes draw_record(std::mt19937& random, const DisparityContext& context) {
  vectors::FieldRules rules(vectors::Json{{"disparity_density", 100}});
  vectors::Random numbers(random());
  Bytes bytes = vectors::draw_disparity_record(rules, context, numbers);
  const int fault = test::draw(random, 0, 3);
  if (fault == 1) {
    SequenceFields values{12, std::vector<uint32_t>(context.blocks()), {}};
    for (uint32_t& value : values.values) value = numbers.below(32);
    BitWriter writer;
    put_disparity_fields(writer, 4095 - test::draw(random, 0, 30), values);
    bytes = writer.take();
  }
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
    test::StreamParts parts(draw_disparity_header(random));
    const StreamView empty{{}, parts.header, parts.geometry};
    for (size_t m = 0; m < parts.geometry.motion_planes().size(); ++m) {
      const MotionPlaneShape& shape = parts.geometry.motion_planes()[m];
      for (uint32_t i = 0; i < shape.tiles(); ++i) {
        const MotionTilePlace place{0, {0, 0}, m, i % shape.tiles_x, i / shape.tiles_x};
        if (random() % 5 == 0) continue;
        parts.motion_tile(0, {0, 0}, m, place.tx, place.ty) =
            draw_record(random, disparity_context(empty, place));
      }
    }
    const Bytes file = parts.file();
    const StreamHeader header = parse_header(file).value();
    const StreamView stream{file, header, parts.geometry};
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
