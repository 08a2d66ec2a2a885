// What the examples on a GPU share: a Vulkan device that the program opens itself and shares with
// the decoder, and pictures as files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <vulkan/vulkan_raii.hpp>

#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/recording.hpp>
#include <hmlfc/gpu/vulkan_device.hpp>

#include "mapped_file.hpp"

namespace gpu = hmlfc::gpu;

// The value of a result, or an exception with the message of its failure.
template <class T>
T value_of(gpu::Outcome<T>&& outcome) {
  if (!outcome) throw std::runtime_error(outcome.error().message);
  return std::move(*outcome);
}
inline void value_of(gpu::Outcome<void>&& outcome) {
  if (!outcome) throw std::runtime_error(outcome.error().message);
}

// Device and queue of a program: instance, device and feature are what open_device asks for.
struct Vulkan {
  Vulkan() {
    const vk::ApplicationInfo application("example", 1, nullptr, 0, VK_API_VERSION_1_2);
    instance.emplace(context, vk::InstanceCreateInfo({}, &application));
    physical.emplace(std::move(instance->enumeratePhysicalDevices().front()));
    const auto families = physical->getQueueFamilyProperties();
    while (!(families.at(family).queueFlags & vk::QueueFlagBits::eCompute)) ++family;
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queues({}, family, 1, &priority);
    vk::PhysicalDeviceVulkan12Features features;
    features.bufferDeviceAddress = VK_TRUE;  // for the decoder
    features.timelineSemaphore = VK_TRUE;    // for this program
    const vk::DeviceCreateInfo info({}, queues, {}, {}, {}, &features);
    device.emplace(*physical, info);
    queue.emplace(*device, family, 0);
    const VkDeviceCreateInfo& created = info;
    decoder_device.emplace(
        value_of(gpu::open_device({**instance, **physical, **device, &created, family, **queue})));
  }

  // Memory for a buffer or an image, bound to it.
  template <class Resource>
  vk::raii::DeviceMemory allocate(Resource& resource, vk::MemoryPropertyFlags wanted) const {
    const vk::MemoryRequirements needs = resource.getMemoryRequirements();
    const auto types = physical->getMemoryProperties();
    uint32_t type = 0;
    while ((needs.memoryTypeBits >> type & 1u) == 0 ||
           (types.memoryTypes.at(type).propertyFlags & wanted) != wanted) {
      ++type;
    }
    vk::raii::DeviceMemory memory(*device, vk::MemoryAllocateInfo(needs.size, type));
    resource.bindMemory(*memory, 0);
    return memory;
  }

  vk::raii::Context context;
  std::optional<vk::raii::Instance> instance;
  std::optional<vk::raii::PhysicalDevice> physical;
  uint32_t family = 0;
  std::optional<vk::raii::Device> device;
  std::optional<vk::raii::Queue> queue;
  std::optional<gpu::Device> decoder_device;  // the first to go
};

// Texels as binary PPM: one byte a sample at depth 8, else two, the higher first. Throws where they
// cannot be written.
inline void write_ppm(const std::string& path, VkExtent2D size, const hmlfc::StreamHeader& header,
                      const uint8_t* texels) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << size.width << ' ' << size.height << '\n' << (1 << header.depth) - 1 << '\n';
  const size_t bytes = gpu::texel_bytes(header) / 4;  // of a sample
  for (size_t i = 0; i < size_t{4} * size.width * size.height; ++i) {
    if (i % 4 == 3) continue;  // A
    for (size_t k = bytes; k-- > 0;) file.put(static_cast<char>(texels[i * bytes + k]));
  }
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot write");
}

// Calls `work` with the stream in the file `path`. Returns the exit status: 1 an error, 3 no Vulkan
// device, each with a message.
template <class Work>
int run_on_stream(const char* path, const Work& work) {
  const MappedFile file(path);  // outlives the stream
  const auto stream = hmlfc::Decoder::open(file.bytes());
  if (!stream) {
    std::fprintf(stderr, "%s\n", to_string(stream.error()).c_str());
    return 1;
  }
  try {
    work(*stream);
  } catch (const vk::IncompatibleDriverError&) {
    std::fprintf(stderr, "no Vulkan device\n");
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
