// Disparities in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Writes a grey PFM: `pixels`, width * height numbers row by row from the top, as 32-bit floating
/// point, little-endian. Errors: cannot write.
IoResult<void> write_pfm(const std::filesystem::path& path, uint32_t width, uint32_t height,
                         std::span<const float> pixels);

/// Width and height, each in [1, kMaxMapSide], and the pixels row by row from the top.
struct FloatMap {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> pixels;  ///< where nothing is known perhaps not finite
};
inline constexpr uint32_t kMaxMapSide = 65536;

/// Reads a grey PFM of either byte order. Errors: cannot read, no grey PFM, another number of bytes
/// than its head says.
IoResult<FloatMap> read_pfm(const std::filesystem::path& path);

}  // namespace hmlfc::io
