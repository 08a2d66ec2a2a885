// Bytes of a stream by image, plane and level.
#include "view/image_bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include <hmlfc/stream_info.hpp>

#include "handler_fixture.hpp"
#include "view/plane_trace.hpp"

namespace hmlfc::view {
namespace {

// Bytes of records as they were written; residuals as each block's trace has them.
TEST(ViewImageBytes, AreThoseOfTheRecordsAndBlocks) {
  for (const int height : {0, 1}) {
    StreamHeader header = test::row_of_views(height);
    header.rows = 4;
    header.cluster_rows = 2;
    const auto bytes = test::drawn_stream(header, 11);
    OpenStream stream("a.hmlfc", bytes);
    const Decoder& decoder = stream.for_blocks().decoder();
    const test::StreamParts parts(bytes);
    const auto counted = image_bytes(decoder);
    ASSERT_TRUE(counted);
    std::map<uint32_t, uint64_t> level_counts;
    std::map<uint32_t, uint64_t> steps;
    uint64_t tile = 0;
    uint64_t keys = 0;
    for (const LevelBytes& level : counted->levels) {
      ASSERT_EQ(level.images.size(), level.rows * level.cols);
      EXPECT_GT(level.rows, 1u);
      for (size_t image = 0; image < level.images.size(); ++image) {
        uint64_t expected = 0;
        for (uint64_t t = 0; t < parts.geometry.tiles_per_image(); ++t) {
          expected += parts.records[tile++].size();
        }
        const auto row = static_cast<uint32_t>(image / level.cols);
        const auto col = static_cast<uint32_t>(image % level.cols);
        const bool key = parts.geometry.is_key(level.level, {row, col});
        EXPECT_EQ(level.images[image] > expected, key);
        if (key) keys += level.images[image] - expected;
        if (!key) {
          EXPECT_EQ(level.images[image], expected);
        }
        const uint32_t side = level.level == 0 ? 1 : 2;  // views of an image
        const ViewPos view{side * row, side * col};
        for (const Plane plane : kPlanes) {
          const PlaneTrace trace = trace_plane(decoder, view, plane, level.level);
          for (const uint32_t count : trace.level_counts) level_counts[count] += count > 0;
          for (const uint32_t step : trace.steps) steps[step] += step > 0;
        }
      }
    }
    level_counts.erase(0);
    steps.erase(0);
    EXPECT_EQ(counted->level_counts, level_counts);
    EXPECT_EQ(counted->steps, steps);
    const uint64_t table = 3 * 16 * parts.geometry.key_count();
    EXPECT_EQ(keys + table, parts.top.size());
  }
}

}  // namespace
}  // namespace hmlfc::view
