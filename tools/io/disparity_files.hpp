// Disparities in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Writes a grey PFM: `pixels`, width * height numbers row by row from the top, as 32-bit floating
/// point, little-endian. Errors: cannot write.
IoResult<void> write_pfm(const std::filesystem::path& path, uint32_t width, uint32_t height,
                         std::span<const float> pixels);

}  // namespace hmlfc::io
