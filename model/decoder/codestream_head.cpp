#include "decoder/jpeg2000.hpp"

#include <cstddef>

#include "arithmetic/rounding.hpp"

namespace hmlfc {
namespace {

enum Marker : uint32_t {
  kSoc = 0xFF4F,
  kSiz = 0xFF51,
  kCod = 0xFF52,
  kQcd = 0xFF5C,
  kCom = 0xFF64,
  kSot = 0xFF90,
  kSod = 0xFF93,
  kEoc = 0xFFD9,
};

// Offsets of fields from the marker of their segment.
constexpr size_t kSizCapabilities = 4;
constexpr size_t kSizImageWidth = 6;
constexpr size_t kSizImageHeight = 10;
constexpr size_t kSizImageOrigin = 14;  // two fields
constexpr size_t kSizTileWidth = 22;
constexpr size_t kSizTileHeight = 26;
constexpr size_t kSizTileOrigin = 30;  // two fields
constexpr size_t kSizComponents = 38;
constexpr size_t kSizPrecision = 40;
constexpr size_t kSizSubsampling = 41;  // two fields
constexpr size_t kSizBytes = 43;
constexpr size_t kCodStyle = 4;
constexpr size_t kCodProgression = 5;
constexpr size_t kCodLayers = 6;
constexpr size_t kCodComponentTransform = 8;
constexpr size_t kCodDecompositions = 9;
constexpr size_t kCodBlockWidth = 10;
constexpr size_t kCodBlockHeight = 11;
constexpr size_t kCodBlockStyle = 12;
constexpr size_t kCodTransform = 13;
constexpr size_t kCodPrecincts = 14;
constexpr size_t kQcdStyle = 4;
constexpr size_t kQcdExponents = 5;
constexpr size_t kSotTile = 4;
constexpr size_t kSotTilePartBytes = 6;
constexpr size_t kSotTilePart = 10;
constexpr size_t kSotTileParts = 11;
constexpr size_t kSotBytes = 12;
constexpr size_t kMarkerBytes = 2;

constexpr uint32_t kOtherParts = 0xC000;  // bits of Rsiz: extensions, high throughput
constexpr uint32_t kSigned = 0x80;        // bit of Ssiz
constexpr uint32_t kOwnPrecincts = 1;     // bit of Scod; bits 1 and 2 are SOP and EPH
constexpr uint32_t kGreatestPrecinct = 0xFF;
constexpr uint32_t kReversible = 1;
constexpr uint32_t kGreatestTile = 0x7FFFFFFF;

// Big-endian fields; those past the end read as 0, which is no marker.
class Segments {
 public:
  explicit Segments(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  uint32_t field(size_t at, size_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at) return 0;
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) value = (value << 8) | bytes_[at + i];
    return value;
  }
  uint32_t marker(size_t at) const { return field(at, kMarkerBytes); }
  size_t after(size_t at) const { return at + kMarkerBytes + field(at + kMarkerBytes, 2); }
  size_t size() const { return bytes_.size(); }

 private:
  std::span<const uint8_t> bytes_;
};

bool is_one_tile(const Segments& segments, size_t siz, uint32_t width, uint32_t height) {
  const auto field = [&](size_t offset) { return segments.field(siz + offset, 4); };
  return field(kSizImageWidth) == width && field(kSizImageHeight) == height &&
         field(kSizImageOrigin) == 0 && field(kSizImageOrigin + 4) == 0 &&
         field(kSizTileWidth) >= width && field(kSizTileWidth) <= kGreatestTile &&
         field(kSizTileHeight) >= height && field(kSizTileHeight) <= kGreatestTile &&
         field(kSizTileOrigin) == 0 && field(kSizTileOrigin + 4) == 0;
}

bool is_one_component(const Segments& segments, size_t siz, SamplePrecision precision) {
  const uint32_t sign = precision.is_signed ? kSigned : 0;
  return segments.marker(siz) == kSiz && segments.after(siz) == siz + kSizBytes &&
         (segments.field(siz + kSizCapabilities, 2) & kOtherParts) == 0 &&
         segments.field(siz + kSizComponents, 2) == 1 &&
         segments.field(siz + kSizPrecision, 1) ==
             sign + static_cast<uint32_t>(precision.bits) - 1 &&
         segments.field(siz + kSizSubsampling, 2) == 0x0101;
}

bool has_greatest_precincts(const Segments& segments, size_t cod) {
  const uint32_t resolutions = segments.field(cod + kCodDecompositions, 1) + 1;
  const bool own = (segments.field(cod + kCodStyle, 1) & kOwnPrecincts) != 0;
  const uint32_t bytes = own ? resolutions : 0;
  if (segments.after(cod) != cod + kCodPrecincts + bytes) return false;
  for (uint32_t i = 0; i < bytes; ++i) {
    if (segments.field(cod + kCodPrecincts + i, 1) != kGreatestPrecinct) return false;
  }
  return true;
}

bool is_allowed_cod(const Segments& segments, size_t cod) {
  const auto field = [&](size_t offset) { return segments.field(cod + offset, 1); };
  return field(kCodStyle) <= 7 && field(kCodProgression) <= 4 &&
         segments.field(cod + kCodLayers, 2) >= 1 && field(kCodComponentTransform) == 0 &&
         field(kCodDecompositions) <= (field(kCodProgression) <= 1 ? 32 : 15) &&
         field(kCodBlockWidth) + field(kCodBlockHeight) <= 8 && field(kCodBlockStyle) <= 63 &&
         field(kCodTransform) == kReversible && has_greatest_precincts(segments, cod);
}

// Exponents alone, without quantization, one for each subband of `decompositions`.
bool is_allowed_qcd(const Segments& segments, size_t qcd, uint32_t decompositions) {
  const uint32_t subbands = 3 * decompositions + 1;
  if ((segments.field(qcd + kQcdStyle, 1) & 31) != 0 ||
      segments.after(qcd) != qcd + kQcdExponents + subbands) {
    return false;
  }
  for (uint32_t i = 0; i < subbands; ++i) {
    if ((segments.field(qcd + kQcdExponents + i, 1) & 7) != 0) return false;
  }
  return true;
}

// A tile-part of length 0 reaches to EOC; 0 tile-parts leave their number open. The EOC that ends
// the codestream must follow this tile-part, so that no other, with a header of its own, can stand
// between.
bool is_only_tile_part(const Segments& segments, size_t sot) {
  const size_t end = segments.size() - kMarkerBytes;
  const uint32_t bytes = segments.field(sot + kSotTilePartBytes, 4);
  return segments.after(sot) == sot + kSotBytes && segments.field(sot + kSotTile, 2) == 0 &&
         (bytes == 0 || bytes == end - sot) && segments.field(sot + kSotTilePart, 1) == 0 &&
         segments.field(sot + kSotTileParts, 1) <= 1 && segments.marker(sot + kSotBytes) == kSod &&
         segments.marker(end) == kEoc;
}

constexpr size_t kAtSiz = 2;

}  // namespace

bool has_key_image_head(std::span<const uint8_t> codestream, uint32_t width, uint32_t height,
                        SamplePrecision precision) {
  const Segments segments(codestream);
  if (segments.marker(0) != kSoc || !is_one_component(segments, kAtSiz, precision) ||
      !is_one_tile(segments, kAtSiz, width, height)) {
    return false;
  }
  size_t cod = 0;  // 0: none yet
  size_t qcd = 0;
  for (size_t at = segments.after(kAtSiz);; at = segments.after(at)) {
    switch (segments.marker(at)) {
      case kCod:
        if (cod != 0 || !is_allowed_cod(segments, at)) return false;
        cod = at;
        break;
      case kQcd:
        if (qcd != 0) return false;
        qcd = at;
        break;
      case kCom:
        break;
      case kSot:
        return cod != 0 && qcd != 0 &&
               is_allowed_qcd(segments, qcd, segments.field(cod + kCodDecompositions, 1)) &&
               is_only_tile_part(segments, at);
      default:
        return false;
    }
  }
}

uint64_t code_blocks_of(std::span<const uint8_t> codestream, uint32_t width, uint32_t height) {
  const Segments segments(codestream);
  size_t cod = segments.after(kAtSiz);
  while (segments.marker(cod) != kCod) cod = segments.after(cod);
  const unsigned width_log2 = segments.field(cod + kCodBlockWidth, 1) + 2;
  const unsigned height_log2 = segments.field(cod + kCodBlockHeight, 1) + 2;
  const auto blocks = [&](uint64_t w, uint64_t h) {
    return ceil_div(w, uint64_t{1} << width_log2) * ceil_div(h, uint64_t{1} << height_log2);
  };
  // Each decomposition halves a band into a low part, rounded up, and a high part (B.5).
  uint64_t count = 0;
  uint64_t w = width;
  uint64_t h = height;
  for (uint32_t n = segments.field(cod + kCodDecompositions, 1); n > 0; --n) {
    const uint64_t low_w = w - w / 2;
    const uint64_t low_h = h - h / 2;
    count += blocks(w / 2, low_h) + blocks(low_w, h / 2) + blocks(w / 2, h / 2);
    w = low_w;
    h = low_h;
  }
  return count + blocks(w, h);
}

}  // namespace hmlfc
