// Keeps what a driver has compiled in a file for the next process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// Returns the folder hmlfc in $XDG_CACHE_HOME, else in $HOME/.cache; nothing where neither is a
/// full path.
std::filesystem::path default_cache_folder();

/// The file of one device. Processes may use it at once: a file is replaced as a whole.
class KernelCacheFile {
 public:
  /// An empty folder means that there is no file.
  KernelCacheFile(const std::filesystem::path& folder,
                  const vk::PhysicalDeviceProperties& properties);

  /// What was written for this device and this version of its driver; empty where there is no such
  /// file, or it is not as it was written.
  std::vector<uint8_t> read() const;

  /// Writes `data` and returns whether that could be done.
  bool write(std::span<const uint8_t> data) const noexcept;

  const std::filesystem::path& path() const { return path_; }

 private:
  bool fits(std::span<const uint8_t> data) const;

  vk::PhysicalDeviceProperties properties_;
  std::filesystem::path path_;
};

}  // namespace hmlfc::gpu
