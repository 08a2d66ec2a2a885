// The guard of the bounds tests itself: a kernel that writes past its buffer ends the process, or
// on a GPU the device.
#include <cstdlib>

#include "buffer.hpp"
#include "commands.hpp"
#include "gpu/gpu_test.hpp"
#include "stream_shape.hpp"

namespace hmlfc::gpu {
namespace {

class GpuBoundsFault : public GpuTest {};

// expand.comp with more requests than its buffer has room for, by less than a page.
void overrun(uint32_t requests) {
  DeviceOptions options;
  options.guard_pages = true;
  auto device = Device::open(options);
  Device::State& state = device->state();
  const Buffer shape(state, sizeof(StreamShapeRecord), Memory::kDevice);
  const Buffer areas(state, sizeof(AreaRecord), Memory::kUpload);
  areas.records<AreaRecord>()[0] = {};
  const Buffer room(state, uint64_t{1024} * kRequestBytes, Memory::kDevice);
  Arguments arguments;
  arguments.shape = shape.address();
  arguments.areas = areas.address();
  arguments.area_count = 1;
  arguments.requests = room.address();
  arguments.request_count = requests;
  Commands commands(state);
  commands.dispatch("expand", {}, arguments, requests);
  try {
    commands.run();
  } catch (const vk::DeviceLostError&) {
    std::abort();
  }
}

TEST_F(GpuBoundsFault, EndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  overrun(1024);
  EXPECT_DEATH(overrun(1100), "");
}

}  // namespace
}  // namespace hmlfc::gpu
