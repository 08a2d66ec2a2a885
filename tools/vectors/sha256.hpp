// SHA-256 of files, as the manifest writes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace hmlfc::vectors {

/// The SHA-256 of `bytes` in 64 lower-case hexadecimal digits. Throws std::bad_alloc where the
/// library has no memory.
std::string sha256(std::span<const uint8_t> bytes);

}  // namespace hmlfc::vectors
