// Kernels from files, instead of the library's own.
#pragma once

#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <hmlfc/gpu/device.hpp>

#include "io/files.hpp"

namespace hmlfc::gpu {

/// The kernels of the files NAME.spv of a folder. Throws std::runtime_error where one cannot be
/// read, and std::filesystem::filesystem_error for the folder.
inline KernelCode read_kernels(const std::filesystem::path& folder) {
  KernelCode kernels;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".spv") continue;
    const auto file = io::map_file(entry.path());
    if (!file) throw std::runtime_error(file.error().message);
    auto& words = kernels[entry.path().stem().string()];
    words.resize(file->bytes().size() / 4);
    std::memcpy(words.data(), file->bytes().data(), 4 * words.size());
  }
  return kernels;
}

}  // namespace hmlfc::gpu
