#include "decoder/jpeg2000.hpp"

#include <cstddef>

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
constexpr size_t kSizImageWidth = 6;
constexpr size_t kSizImageHeight = 10;
constexpr size_t kSizImageOrigin = 14;  // two fields
constexpr size_t kSizTileWidth = 22;
constexpr size_t kSizTileHeight = 26;
constexpr size_t kSizTileOrigin = 30;  // two fields
constexpr size_t kSizComponents = 38;
constexpr size_t kCodStyle = 4;
constexpr size_t kCodTransform = 13;
constexpr size_t kSotTile = 4;
constexpr size_t kSotTilePartBytes = 6;
constexpr size_t kSotTilePart = 10;
constexpr size_t kSotTileParts = 11;
constexpr size_t kSotBytes = 12;
constexpr size_t kMarkerBytes = 2;

constexpr uint32_t kOwnPrecincts = 1;  // bit of the coding style
constexpr uint32_t kReversible = 1;

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
  return segments.marker(siz) == kSiz && field(kSizImageWidth) == width &&
         field(kSizImageHeight) == height && field(kSizImageOrigin) == 0 &&
         field(kSizImageOrigin + 4) == 0 && field(kSizTileWidth) >= width &&
         field(kSizTileHeight) >= height && field(kSizTileOrigin) == 0 &&
         field(kSizTileOrigin + 4) == 0 && segments.field(siz + kSizComponents, 2) == 1;
}

bool is_reversible(const Segments& segments, size_t cod) {
  return (segments.field(cod + kCodStyle, 1) & kOwnPrecincts) == 0 &&
         segments.field(cod + kCodTransform, 1) == kReversible;
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

}  // namespace

bool has_key_image_head(std::span<const uint8_t> codestream, uint32_t width, uint32_t height) {
  const Segments segments(codestream);
  constexpr size_t kAtSiz = 2;
  if (segments.marker(0) != kSoc || !is_one_tile(segments, kAtSiz, width, height)) return false;
  bool has_cod = false;
  bool has_qcd = false;
  for (size_t at = segments.after(kAtSiz);; at = segments.after(at)) {
    switch (segments.marker(at)) {
      case kCod:
        if (has_cod || !is_reversible(segments, at)) return false;
        has_cod = true;
        break;
      case kQcd:
        if (has_qcd) return false;
        has_qcd = true;
        break;
      case kCom:
        break;
      case kSot:
        return has_cod && has_qcd && is_only_tile_part(segments, at);
      default:
        return false;
    }
  }
}

}  // namespace hmlfc
