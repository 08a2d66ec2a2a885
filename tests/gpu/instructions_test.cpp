// What the kernels execute a pixel, on lavapipe: it may fall, and must not rise.
#include <hmlfc/encoder.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "gpu/instruction_report.hpp"
#include "scenes/scene.hpp"

namespace hmlfc::gpu {
namespace {

class GpuInstructions : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!IsSkipped() && device().info().kind != "CPU") GTEST_SKIP() << "counted on lavapipe alone";
  }
};

std::vector<uint8_t> knights(Profile profile) {
  scenes::SceneParams params;
  params.scene = scenes::Scene::kKnights;
  params.rows = 4;
  params.cols = 4;
  params.width = 64;
  params.height = 48;
  EncodeParams coding;
  coding.profile = profile;
  return encode(scenes::render_scene(params, 1), coding)->bytes;
}

Camera camera_of(uint32_t size) {
  Camera camera;
  camera.frame_width = size;
  camera.frame_height = size;
  return camera;
}

double a_pixel(uint64_t count, const InstructionTable& table) {
  return static_cast<double>(count) / static_cast<double>(table.pixels);
}

// Counts a pixel, up to a tenth above what was measured last.
struct Limits {
  double instructions, loads, atomics;
};

void expect_within(const Outcome<InstructionTable>& table, const Limits& limits) {
  ASSERT_TRUE(table) << table.error().message;
  const KernelCounts total = table->total();
  const std::string text = to_text(*table);
  EXPECT_LE(a_pixel(total.instructions, *table), limits.instructions) << text;
  EXPECT_GE(a_pixel(total.instructions, *table), 0.9 * limits.instructions) << "lower the limit\n"
                                                                            << text;
  EXPECT_LE(a_pixel(total.loads, *table), limits.loads) << text;
  EXPECT_LE(a_pixel(total.atomics, *table), limits.atomics) << text;
}

// The stores follow from the layouts: a block of 4 x 4 pixels takes 24 words and a status, and a
// frame's pixel 16 bytes for its ray and half of three words, but for a few of the plan and the
// results.
TEST_F(GpuInstructions, APixelTakesNoMoreThanBefore) {
  auto report = InstructionReport::open({});
  ASSERT_TRUE(report) << report.error().message;
  const auto extended = knights(Profile::kExtended);
  const auto main = knights(Profile::kMain);
  const auto view = open_stream(extended, {});
  const auto main_view = open_stream(main, {});
  ASSERT_TRUE(view && main_view);
  const auto decoded = report->decode(*view, 3);
  expect_within(decoded, {810, 32, 0});
  EXPECT_EQ(16 * decoded->kernels.at("colour").stores, 25 * decoded->pixels);
  expect_within(report->decode(*main_view, 3), {640, 21, 0});
  const auto cold = report->frames(*view, camera_of(128), true);
  expect_within(cold, {1630, 22, 0.6});
  const auto pixels = static_cast<double>(cold->pixels);
  EXPECT_NEAR(static_cast<double>(cold->kernels.at("mark").stores), pixels, 100);
  EXPECT_NEAR(static_cast<double>(cold->kernels.at("render").stores), 1.5 * pixels, 100);
  expect_within(report->frames(*view, camera_of(256), false), {1170, 4, 0.4});
}

}  // namespace
}  // namespace hmlfc::gpu
