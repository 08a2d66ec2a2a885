// Prints what the driver of a device says of every kernel in every variant that the library
// dispatches, a line of JSON each. For tests/gpu/kernel_limits.py.
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "device_state.hpp"

namespace hmlfc::gpu {
namespace {

constexpr int kSkipped = 77;
constexpr const char* kUseNames[] = {"references", "blocks", "stages",       "frames",
                                     "geometry",   "texels", "frame texels", "geometry texels"};

// The driver's name of its version, such as "Mesa 22.3.6".
std::string driver_of(Device& device) {
  const auto properties =
      device.state()
          .physical
          ->getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  return properties.get<vk::PhysicalDeviceDriverProperties>().driverInfo.data();
}

void print(Device& device, KernelUse use, bool chunked) {
  const Variant variant = variant_of(use, chunked, chunked);
  for (const std::string_view kernel : kernels_of(use)) {
    nlohmann::ordered_json line{{"driver", driver_of(device)},
                                {"kernel", kernel},
                                {"use", kUseNames[static_cast<size_t>(use)]},
                                {"chunked", chunked}};
    line["statistics"] = device.state().kernels->statistics(std::string(kernel), variant);
    fmt::print("{}\n", line.dump());
  }
}

int run(const std::string& name) {
  DeviceOptions options;
  options.device = name;
  options.kernel_statistics = true;
  options.cache_folder = "";
  auto device = Device::open(options);
  if (!device) {
    fmt::print("{}\n", device.error().message);
    return kSkipped;
  }
  for (const KernelUse use : kKernelUses) {
    for (const bool chunked : {false, true}) print(*device, use, chunked);
  }
  return 0;
}

}  // namespace
}  // namespace hmlfc::gpu

int main(int argc, char** argv) { return argc == 2 ? hmlfc::gpu::run(argv[1]) : 2; }
