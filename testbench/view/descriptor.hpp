// Descriptors of the view queue (docs/view_unit.md).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hmlfc::tb {

/// What is stored.
enum class ViewFormat : uint8_t {
  kY,
  kCo,
  kCg,
  kRgb888 = 4,
  kRgb101010,
  kRgb161616,
  kResidualsY = 8,
  kResidualsCo,
  kResidualsCg
};

/// Whether strips of a reference image's residuals are stored.
constexpr bool is_residuals(ViewFormat format) {
  return format >= ViewFormat::kResidualsY && format <= ViewFormat::kResidualsCg;
}

inline constexpr std::array<std::string_view, 7> kViewFormatNames{
    "y", "co", "cg", "", "rgb888", "rgb101010", "rgb161616"};

/// Bytes of a pixel or a sample.
constexpr unsigned bytes_of(ViewFormat format) {
  switch (format) {
    case ViewFormat::kRgb888:
      return 3;
    case ViewFormat::kRgb101010:
      return 4;
    case ViewFormat::kRgb161616:
      return 6;
    default:
      return 2;
  }
}

/// Bits of a component of a pixel, or of a sample.
constexpr unsigned bits_of(ViewFormat format) {
  if (format == ViewFormat::kRgb888) return 8;
  return format == ViewFormat::kRgb101010 ? 10 : 16;
}

inline constexpr unsigned kDescriptorBytes = 64;
inline constexpr unsigned kViewStatusBytes = 16;

/// What the status of a descriptor says.
enum class ViewResult : uint8_t { kOk, kBlocks, kRefused, kBus, kAborted };

/// One descriptor; the fields have the widths of memory.
struct Descriptor {
  uint32_t tag = 0;
  uint32_t row = 0;
  uint32_t col = 0;
  unsigned stop_level = 0;
  ViewFormat format = ViewFormat::kRgb888;
  uint32_t x = 0, y = 0, width = 0, height = 0;
  uint64_t destination = 0;
  uint32_t pitch = 0;
  uint64_t bitmap = 0;

  std::array<uint32_t, kDescriptorBytes / 4> words() const {
    return {tag,
            row | col << 12 | stop_level << 24 | static_cast<uint32_t>(format) << 28,
            x | y << 16,
            width | height << 16,
            static_cast<uint32_t>(destination),
            static_cast<uint32_t>(destination >> 32),
            pitch,
            0,
            static_cast<uint32_t>(bitmap),
            static_cast<uint32_t>(bitmap >> 32)};
  }
};

}  // namespace hmlfc::tb
