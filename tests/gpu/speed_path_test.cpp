// The frames that speed is measured with lie between four views.
#include <gtest/gtest.h>

#include "gpu/frame_path.hpp"

namespace hmlfc::gpu {
namespace {

StreamHeader header_of(uint32_t views) {
  StreamHeader header;
  header.rows = header.cols = static_cast<decltype(header.rows)>(views);
  header.width = header.height = 64;
  return header;
}

TEST(GpuSpeedPath, ReadsFourViewsAPixelInEveryGrid) {
  for (const uint32_t views : {2u, 3u, 4u, 9u, 16u}) {
    for (const uint64_t frames : {1u, 2u, 3u, 12u}) {
      const auto records = records_of_path({}, header_of(views), frames);
      ASSERT_TRUE(records) << records.error().message;
      EXPECT_GE(mean_views(*records), kLeastViews) << views << " views, " << frames << " frames";
    }
  }
}

// On the row in the middle, which the check must refuse.
TEST(GpuSpeedPath, OnARowReadsTwoViewsAPixel) {
  Camera camera;
  camera.position = WorldPoint{3.5, 4, 0};
  const auto record = frame_record(camera, header_of(9));
  ASSERT_TRUE(record);
  EXPECT_LE(mean_views({&*record, 1}), 2.0);
}

}  // namespace
}  // namespace hmlfc::gpu
