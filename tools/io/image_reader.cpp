#include "io/image_reader.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

namespace hmlfc::io {
namespace {

/// Numbers of a TIFF header in either byte order; 0 where the bytes end.
class TiffNumbers {
 public:
  explicit TiffNumbers(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  uint32_t read(uint64_t at, int count) const {
    uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      const int from = bytes_[0] == 'M' ? i : count - 1 - i;
      value = value << 8 | byte(at + static_cast<uint64_t>(from));
    }
    return value;
  }

 private:
  uint32_t byte(uint64_t at) const { return at < bytes_.size() ? bytes_[at] : 0; }

  std::span<const uint8_t> bytes_;
};

bool holds(std::span<const uint8_t> bytes, std::string_view text) {
  return !std::ranges::search(bytes, text, [](uint8_t a, char b) {
            return a == static_cast<uint8_t>(b);
          }).empty();
}

IoResult<RgbImage> read_source(const ImageSource& source) {
  if (source.bytes.empty()) return file_error(source.path, "the file is empty; give a picture");
  if (is_png(source.bytes)) return read_png(source);
  if (is_jpeg(source.bytes)) return read_jpeg(source);
  if (is_tiff(source.bytes)) return read_tiff(source);
  if (is_webp(source.bytes)) return read_webp(source);
  if (is_pnm(source.bytes)) return read_pnm(source);
  return file_error(source.path,
                    "not a PNG, JPEG, TIFF, WebP, PPM or PGM picture; convert it to one of these");
}

}  // namespace

void ImageSource::note_depth(int bits, const RgbImage& image) const {
  if (bits <= 12) return;
  const auto most = std::ranges::max_element(image.samples);
  const bool low = most != image.samples.end() && *most > 0 && *most < 256;
  note("samples of " + std::to_string(bits) +
       " bits are reduced to 12 bits, the most that a stream holds" +
       (low ? "; these are below 4096: if they are of 12 bits, multiply them by 16 first" : ""));
}

void ImageSource::note_surplus(size_t count) const {
  if (count > 0) note(kSurplusNote);
}

void ImageSource::note_profile(std::span<const uint8_t> profile) const {
  using namespace std::string_view_literals;
  if (profile.empty() || holds(profile, "sRGB"sv) || holds(profile, "s\0R\0G\0B"sv)) return;
  note("its colour profile is not applied: samples are as stored");
}

tl::unexpected<IoError> damaged(const ImageSource& source, const std::string& what) {
  return file_error(source.path, what + "; the file is damaged");
}

tl::unexpected<IoError> unsupported(const ImageSource& source, const std::string& what,
                                    const std::string& cure) {
  return file_error(source.path, what + "; not supported: " + cure);
}

IoResult<RgbImage> allocate_image(const ImageSource& source, uint64_t width, uint64_t height,
                                  int depth) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    return file_error(source.path,
                      "a picture of " + size + " pixels; each side must be 1 to 65536");
  }
  const uint64_t samples = width * height * 3;  // at most 3 * 2^32
  if (samples > source.limits.max_samples) {
    return file_error(source.path, "a picture of " + size + " pixels is over the limit of " +
                                       std::to_string(source.limits.max_samples / 3) + " pixels");
  }
  RgbImage image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), depth, {}};
  try {
    image.samples.resize(samples);
  } catch (const std::bad_alloc&) {
    return memory_error(source.path, "for a picture of " + size + " pixels");
  }
  return image;
}

void widen_bytes(RgbImage& image) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(image.samples.data());
  for (size_t i = image.samples.size(); i-- > 0;) image.samples[i] = bytes[i];
}

int exif_orientation(std::span<const uint8_t> exif) {
  constexpr std::array<uint8_t, 6> kPrefix = {'E', 'x', 'i', 'f', 0, 0};
  constexpr uint32_t kOrientation = 0x0112;
  constexpr uint32_t kShort = 3;
  if (exif.size() >= 6 && std::ranges::equal(exif.first(6), kPrefix)) exif = exif.subspan(6);
  if (exif.size() < 8 || exif[0] != exif[1] || (exif[0] != 'I' && exif[0] != 'M')) return 1;
  const TiffNumbers numbers(exif);
  const uint64_t directory = numbers.read(4, 4);
  const uint32_t entries = numbers.read(directory, 2);
  for (uint32_t i = 0; i < entries; ++i) {
    const uint64_t entry = directory + 2 + uint64_t{12} * i;
    if (numbers.read(entry, 2) != kOrientation || numbers.read(entry + 2, 2) != kShort) continue;
    const auto value = static_cast<int>(numbers.read(entry + 8, 2));
    return value >= 1 && value <= 8 ? value : 1;
  }
  return 1;
}

/// Orientation 6, for example, says that the file's rows run from the top right of the picture
/// downwards: the pixel (x, y) of the picture is (y, height - 1 - x) in the file.
IoResult<RgbImage> upright(const ImageSource& source, RgbImage image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  source.note("its EXIF orientation " + std::to_string(orientation) + " is applied");
  const bool transposed = orientation >= 5;
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  auto turned = allocate_image(source, transposed ? image.height : image.width,
                               transposed ? image.width : image.height, image.depth);
  if (!turned) return turned;
  uint16_t* out = turned->samples.data();
  for (uint32_t y = 0; y < turned->height; ++y) {
    for (uint32_t x = 0; x < turned->width; ++x, out += 3) {
      uint32_t column = transposed ? y : x;
      uint32_t row = transposed ? x : y;
      if (from_right) column = image.width - 1 - column;
      if (from_below) row = image.height - 1 - row;
      std::copy_n(image.samples.data() + (size_t{row} * image.width + column) * 3, 3, out);
    }
  }
  return turned;
}

IoResult<RgbImage> read_image(const std::filesystem::path& path, const ImageLimits& limits,
                              Notes* notes) {
  const auto file = map_file(path);
  if (!file) return tl::unexpected(file.error());
  Notes remarks;
  auto image = read_source({path, file->bytes(), limits, remarks});
  if (image && notes != nullptr) notes->add(remarks);
  return image;
}

}  // namespace hmlfc::io
