// Animated pictures. The file appears complete or not at all (see AtomicFile).
#pragma once

#include <filesystem>
#include <span>

#include <hmlfc/image.hpp>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// Writes an animated PNG (APNG) that repeats `frames`, at least one, all of one size and depth,
/// `rate` a second, in [1, 1000]. Programs that know PNG alone show the first. Errors: cannot
/// write.
IoResult<void> write_apng(const std::filesystem::path& path, std::span<const RgbImage> frames,
                          unsigned rate);

}  // namespace hmlfc::io
