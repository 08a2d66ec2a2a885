#include "samples/codestream_shape.hpp"

#include <array>
#include <cstddef>

namespace hmlfc {
namespace {

// Byte offsets from the start of the codestream; all fields are big-endian.
constexpr size_t kAtSoc = 0;
constexpr size_t kAtSiz = 2;
constexpr size_t kAtImageWidth = 8;
constexpr size_t kAtImageHeight = 12;
constexpr size_t kAtImageOrigin = 16;  // two fields
constexpr size_t kAtTileWidth = 24;
constexpr size_t kAtTileHeight = 28;
constexpr size_t kAtTileOrigin = 32;  // two fields
constexpr size_t kAtComponents = 40;
constexpr size_t kEnd = 45;

constexpr uint32_t kSocMarker = 0xFF4F;
constexpr uint32_t kSizMarker = 0xFF51;

uint32_t load_be(std::span<const uint8_t> bytes, size_t at, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) value = (value << 8) | bytes[at + i];
  return value;
}

}  // namespace

bool declares_one_tile(std::span<const uint8_t> codestream, uint32_t width, uint32_t height) {
  if (codestream.size() < kEnd) return false;
  const auto field = [&](size_t at) { return load_be(codestream, at, 4); };
  return load_be(codestream, kAtSoc, 2) == kSocMarker &&
         load_be(codestream, kAtSiz, 2) == kSizMarker && field(kAtImageWidth) == width &&
         field(kAtImageHeight) == height && field(kAtImageOrigin) == 0 &&
         field(kAtImageOrigin + 4) == 0 && field(kAtTileWidth) >= width &&
         field(kAtTileHeight) >= height && field(kAtTileOrigin) == 0 &&
         field(kAtTileOrigin + 4) == 0 && load_be(codestream, kAtComponents, 2) == 1;
}

}  // namespace hmlfc
