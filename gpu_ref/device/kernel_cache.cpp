#include "kernel_cache.hpp"

#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "bits/crc32c.hpp"

namespace hmlfc::gpu {
namespace {

constexpr size_t kCrcBytes = sizeof(uint32_t);

// A folder that the environment names; empty where it is not a full path.
std::filesystem::path folder_of(const char* variable) {
  const char* value = std::getenv(variable);
  const std::filesystem::path path = value == nullptr ? "" : value;
  return path.is_absolute() ? path : std::filesystem::path();
}

bool write_whole(const std::filesystem::path& path, std::span<const uint8_t> data) {
  const uint32_t crc = crc32c(data);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(&crc), kCrcBytes);
  file.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
  file.close();
  return !file.fail();
}

}  // namespace

std::filesystem::path default_cache_folder() {
  if (const auto caches = folder_of("XDG_CACHE_HOME"); !caches.empty()) return caches / "hmlfc";
  if (const auto home = folder_of("HOME"); !home.empty()) return home / ".cache" / "hmlfc";
  return {};
}

KernelCacheFile::KernelCacheFile(const std::filesystem::path& folder,
                                 const vk::PhysicalDeviceProperties& properties)
    : properties_(properties) {
  if (folder.empty()) return;
  char name[32] = {};
  std::snprintf(name, sizeof(name), "kernels-%04" PRIx32 "-%04" PRIx32 ".bin", properties.vendorID,
                properties.deviceID);
  path_ = folder / name;
}

// Whether the driver that wrote `data` is the one at hand.
bool KernelCacheFile::fits(std::span<const uint8_t> data) const {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof(header)) return false;
  std::memcpy(&header, data.data(), sizeof(header));
  return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.headerSize >= sizeof(header) && header.headerSize <= data.size() &&
         header.vendorID == properties_.vendorID && header.deviceID == properties_.deviceID &&
         std::memcmp(header.pipelineCacheUUID, properties_.pipelineCacheUUID.data(),
                     VK_UUID_SIZE) == 0;
}

std::vector<uint8_t> KernelCacheFile::read() const {
  std::ifstream file(path_, std::ios::binary);
  std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() < kCrcBytes) return {};
  uint32_t crc = 0;
  std::memcpy(&crc, bytes.data(), kCrcBytes);
  bytes.erase(bytes.begin(), bytes.begin() + kCrcBytes);
  if (crc32c(bytes) != crc || !fits(bytes)) return {};
  return bytes;
}

bool KernelCacheFile::write(std::span<const uint8_t> data) const noexcept {
  if (path_.empty()) return false;
  try {
    std::error_code error;
    std::filesystem::create_directories(path_.parent_path(), error);
    std::string name = path_.string() + ".XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) return false;
    close(descriptor);
    bool done = write_whole(name, data);
    if (done) std::filesystem::rename(name, path_, error);
    done = done && !error;
    if (!done) std::filesystem::remove(name, error);
    return done;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace hmlfc::gpu
