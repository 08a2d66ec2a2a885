// Choosing a device, and the validation layer's messages.
#include <algorithm>

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

TEST_F(GpuDevice, ThatIsNotThereIsNamedWithThoseThatAre) {
  for (const char* name : {"no such device", "99"}) {
    DeviceOptions options;
    options.device = name;
    const auto device = Device::open(options);
    ASSERT_FALSE(device);
    EXPECT_NE(device.error().message.find(name), std::string::npos) << device.error().message;
    EXPECT_NE(device.error().message.find(list_devices()->front().name), std::string::npos);
  }
}

TEST_F(GpuDevice, RefusesChunksThatAreNoPowerOfTwo) {
  for (const uint64_t bytes : {1u, 32u, 1000u}) {
    DeviceOptions options;
    options.chunk_bytes = bytes;
    EXPECT_FALSE(Device::open(options)) << bytes;
  }
}

TEST_F(GpuDevice, IsUsedAsTheValidationLayerWants) {
  DeviceOptions options;
  options.validation = true;
  auto device = Device::open(options);
  if (!device && device.error().message.find("validation layer") != std::string::npos) {
    GTEST_SKIP() << device.error().message;
  }
  ASSERT_TRUE(device) << device.error().message;
  for (uint32_t seed = 0; seed < 12; ++seed) {
    auto bytes = tb::suite_stream(seed, 2u << seed % 3);
    if (seed % 2 == 1) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    expect_equal(*device, bytes, {.seed = seed});
  }
  for (const std::string& message : device->validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace hmlfc::gpu
