// ERR-1 and SRF-6 on a few hundred cameras. What the test would find: records that are off.
#include <gtest/gtest.h>

#include "render/fixed_point_errors.hpp"

namespace hmlfc {
namespace {

TEST(FixedPoint, StaysWithinTheBoundOfTheRealFrame) {
  const auto errors = test::fixed_point_errors(0, 75, 4);
  EXPECT_LE(errors.worst, 1.0) << errors.worst_at;
  EXPECT_EQ(errors.cameras, 300);
  EXPECT_GT(errors.displaced, 20);
  EXPECT_GT(errors.samples, 100000u);
  EXPECT_GT(errors.worst, 0.1) << "the bound is far above what occurs";
}

TEST(FixedPoint, FramesOfRecordsThatAreOffExceedTheBound) {
  const auto worst = [](const std::function<void(FrameRecord&)>& change) {
    return test::fixed_point_errors(0, 15, 4, change).worst;
  };
  EXPECT_GT(worst([](FrameRecord& record) { record.x0 += 1 << 9; }), 1.0);   // 1/8 pixel
  EXPECT_GT(worst([](FrameRecord& record) { record.v0 += 1 << 11; }), 1.0);  // 1/32 step
  EXPECT_GT(worst([](FrameRecord& record) { record.gain += record.gain >> 6; }), 1.0);
}

}  // namespace
}  // namespace hmlfc
