// Choosing a device, and the validation layer's messages.
#include <algorithm>

#include <hmlfc/gpu/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "device/device_state.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuDevice : public GpuTest {};

TEST_F(GpuDevice, IsChosenByNumberAndByPartOfItsName) {
  const auto devices = list_devices();
  ASSERT_TRUE(devices) << devices.error().message;
  ASSERT_FALSE(devices->empty());
  for (size_t i = 0; i < devices->size(); ++i) {
    if (!(*devices)[i].missing.empty()) continue;
    DeviceOptions options;
    options.device = std::to_string(i);
    const auto numbered = Device::open(options);
    ASSERT_TRUE(numbered) << numbered.error().message;
    EXPECT_EQ(numbered->info().name, (*devices)[i].name);
    options.device = (*devices)[i].name.substr(1, 4);
    std::ranges::transform(options.device, options.device.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_TRUE(Device::open(options));
  }
}

TEST(GpuDeviceChoice, TakesDiscreteGpusFirstAndNoneThatLacksSomething) {
  const std::vector<DeviceInfo> devices = {{"llvmpipe", "CPU", ""},
                                           {"small", "integrated GPU", ""},
                                           {"old", "discrete GPU", "Vulkan 1.2"},
                                           {"large", "discrete GPU", ""},
                                           {"large too", "discrete GPU", ""}};
  EXPECT_EQ(choose_device(devices, ""), 3u);
  EXPECT_EQ(choose_device(devices, "LL"), 1u);
  EXPECT_EQ(choose_device(devices, "pipe"), 0u);
  EXPECT_EQ(choose_device(devices, "2"), 2u);
  EXPECT_EQ(choose_device(devices, "5"), devices.size());
  EXPECT_EQ(choose_device({devices[0], devices[1]}, ""), 1u);
  EXPECT_EQ(choose_device({devices[2]}, ""), 1u);
}

TEST_F(GpuDevice, ThatIsNotThereIsNamedWithThoseThatAre) {
  for (const char* name : {"no such device", "99"}) {
    DeviceOptions options;
    options.device = name;
    const auto device = Device::open(options);
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, FailureKind::kUnusable);
    EXPECT_NE(device.error().message.find(name), std::string::npos) << device.error().message;
    EXPECT_NE(device.error().message.find(list_devices()->front().name), std::string::npos);
  }
}

// Smaller submissions are more of them, with the same blocks.
TEST_F(GpuDevice, SplitsWhatTakesMoreThanItsSubmissions) {
  const auto bytes = tb::suite_stream(2, 4);
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  const PlaneShape& shape = view->geometry.plane(Plane::kY);
  const PixelArea area{{0, 0}, 0, 0, shape.blocks_x, shape.blocks_y, 0};
  uint64_t submitted[2];
  std::vector<int16_t> samples[2];
  for (const bool small : {false, true}) {
    DeviceOptions options;
    if (small) options.submission_bytes = 1;
    auto device = open(options);
    ASSERT_TRUE(device);
    auto decoder = GpuDecoder::open(*device, *view);
    ASSERT_TRUE(decoder);
    submitted[small] = device->counts().submitted;
    const auto pixels = decoder->decode_rgb({&area, 1});
    ASSERT_TRUE(pixels) << pixels.error().message;
    submitted[small] = device->counts().submitted - submitted[small];
    samples[small] = pixels->samples;
  }
  EXPECT_EQ(submitted[0], 1u);
  EXPECT_GT(submitted[1], 1u);
  EXPECT_EQ(samples[0], samples[1]);
}

TEST_F(GpuDevice, RefusesDisparitiesBeyondItsBytes) {
  const auto bytes = tb::suite_stream(2, 4);
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  Camera camera;
  camera.geometry = GeometrySource::kStream;
  const auto record = frame_record(camera, view->header);
  ASSERT_TRUE(record);
  DeviceOptions options;
  options.disparity_bytes = 3;
  auto device = open(options);
  ASSERT_TRUE(device);
  auto renderer = GpuRenderer::open(*device, *view, 0);
  ASSERT_TRUE(renderer);
  const auto frame = renderer->render(*record, 0);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().kind, FailureKind::kLimit) << frame.error().message;
}

TEST_F(GpuDevice, RefusesChunksThatAreNoPowerOfTwo) {
  for (const uint64_t bytes : {1u, 32u, 1000u}) {
    DeviceOptions options;
    options.chunk_bytes = bytes;
    EXPECT_FALSE(Device::open(options)) << bytes;
  }
}

// A device that did not answer in time takes no more calls, and leaves nothing behind.
TEST_F(GpuDevice, WithoutAnAnswerIsLost) {
  auto device = open({});
  ASSERT_TRUE(device);
  const auto bytes = tb::suite_stream(2, 4);
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  auto decoder = GpuDecoder::open(*device, *view);
  auto renderer = GpuRenderer::open(*device, *view, 0);
  ASSERT_TRUE(decoder && renderer);
  const PlaneShape& shape = view->geometry.plane(Plane::kY);
  const BlockArea area{{0, 0}, Plane::kY, 0, 0, shape.blocks_x, shape.blocks_y, 0};
  ASSERT_TRUE(decoder->decode({&area, 1}));
  device->state().timeout_nanoseconds = 0;
  const auto late = decoder->decode({&area, 1});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, FailureKind::kTimeout) << late.error().message;
  device->state().timeout_nanoseconds = 1'000'000'000;
  const auto next = decoder->decode({&area, 1});
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().kind, FailureKind::kLost) << next.error().message;
  const auto record = frame_record(Camera{}, view->header);
  ASSERT_TRUE(record);
  const auto frame = renderer->render(*record, 0);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().kind, FailureKind::kLost);
  auto again = open({});
  ASSERT_TRUE(again);
  expect_equal(*again, bytes, {.requests = 20});
}

TEST_F(GpuDevice, IsUsedAsTheValidationLayerWants) {
  auto device = open_validated();
  ASSERT_TRUE(device);
  for (uint32_t seed = 0; seed < 12; ++seed) {
    auto bytes = tb::suite_stream(seed, 2u << seed % 3);
    if (seed % 2 == 1) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    expect_equal(*device, bytes, {.seed = seed});
  }
  for (const std::string& message : device->validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace hmlfc::gpu
