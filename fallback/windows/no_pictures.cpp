// Views in JPEG, TIFF and WebP, for which there are no libraries here: they are known, and not
// read.
#include <algorithm>
#include <string_view>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

bool begins(std::span<const uint8_t> bytes, size_t at, std::string_view mark) {
  return bytes.size() >= at + mark.size() &&
         std::equal(mark.begin(), mark.end(), &bytes[at],
                    [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

}  // namespace

bool is_jpeg(std::span<const uint8_t> bytes) { return begins(bytes, 0, "\xFF\xD8\xFF"); }
bool is_tiff(std::span<const uint8_t> bytes) {
  using namespace std::string_view_literals;
  return begins(bytes, 0, "II*\0"sv) || begins(bytes, 0, "MM\0*"sv);
}
bool is_webp(std::span<const uint8_t> bytes) {
  return begins(bytes, 0, "RIFF") && begins(bytes, 8, "WEBP");
}

IoResult<RgbImage> read_jpeg(const ImageSource& source) { return unsupported(source, "JPEG"); }
IoResult<RgbImage> read_tiff(const ImageSource& source) { return unsupported(source, "TIFF"); }
IoResult<RgbImage> read_webp(const ImageSource& source) { return unsupported(source, "WebP"); }

}  // namespace hmlfc::io
