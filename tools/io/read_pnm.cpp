// PGM and PPM, plain and binary (P2, P3, P5, P6), and what is said of their relatives.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

struct PnmHeader {
  char kind;  // '2' plain grey, '3' plain colour, '5' binary grey, '6' binary colour
  uint32_t width;
  uint32_t height;
  uint32_t maxval;

  bool plain() const { return kind == '2' || kind == '3'; }
  uint64_t channels() const { return kind == '3' || kind == '6' ? 3 : 1; }
  /// Least number of bytes that the raster of this header takes. Plain samples are at least one
  /// digit each, with a space between two.
  uint64_t min_raster_bytes() const {
    const uint64_t values = uint64_t{width} * height * channels();
    if (plain()) return 2 * values - 1;
    return maxval > 255 ? 2 * values : values;
  }
};

bool is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_decimal(uint8_t c) { return c >= '0' && c <= '9'; }

/// Walks over numbers, white space and comments; never past the end.
class PnmCursor {
 public:
  explicit PnmCursor(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  std::span<const uint8_t> rest() const { return bytes_.subspan(position_); }

  void skip(size_t count) { position_ += count; }

  /// Windows ends the header's line with two bytes: skips the second, if `raster_bytes` follow it.
  void skip_line_feed(uint64_t raster_bytes) {
    const bool two = bytes_[position_ - 1] == '\r' && !at_end() && bytes_[position_] == '\n';
    if (two && rest().size() == raster_bytes + 1) ++position_;
  }

  /// The next decimal number of at most `limit` after any white space and comments.
  std::optional<uint32_t> number(uint32_t limit) {
    skip_blanks();
    if (at_end() || !is_decimal(bytes_[position_])) return std::nullopt;
    uint64_t value = 0;
    for (; !at_end() && is_decimal(bytes_[position_]); ++position_) {
      value = value * 10 + (bytes_[position_] - uint64_t{'0'});
      if (value > limit) return std::nullopt;
    }
    return static_cast<uint32_t>(value);
  }

  void skip_blanks() {
    while (!at_end()) {
      if (bytes_[position_] == '#') {
        while (!at_end() && bytes_[position_] != '\n') ++position_;
      } else if (is_space(bytes_[position_])) {
        ++position_;
      } else {
        return;
      }
    }
  }

  /// The single white space character between the header and a binary raster.
  bool one_space() {
    if (at_end() || !is_space(bytes_[position_])) return false;
    ++position_;
    return true;
  }

 private:
  bool at_end() const { return position_ >= bytes_.size(); }

  std::span<const uint8_t> bytes_;
  size_t position_ = 2;  // after the magic number
};

IoResult<PnmHeader> read_header(const ImageSource& source, PnmCursor& cursor) {
  const char kind = static_cast<char>(source.bytes[1]);
  const auto width = cursor.number(kMaxSide);
  const auto height = width ? cursor.number(kMaxSide) : std::nullopt;
  if (!height || *width == 0 || *height == 0) {
    return file_error(source.path, "PNM header: width and height must be numbers in [1, 65536]");
  }
  const auto maxval = cursor.number(65535);
  if (!maxval || *maxval == 0) {
    return damaged(source, "PNM header: the greatest value must be a number in [1, 65535]");
  }
  return PnmHeader{kind, *width, *height, *maxval};
}

/// All values of the raster, in file order, through `put(index, value)`; false where it ends early
/// or holds a value over maxval.
template <class Put>
bool read_values(const PnmHeader& header, PnmCursor& cursor, const Put& put) {
  const uint64_t values = uint64_t{header.width} * header.height * header.channels();
  const std::span<const uint8_t> raster = cursor.rest();
  for (uint64_t i = 0; i < values; ++i) {
    uint32_t value = 0;
    if (header.plain()) {
      const auto number = cursor.number(header.maxval);
      if (!number) return false;
      value = *number;
    } else {
      value = header.maxval > 255 ? uint32_t{raster[2 * i]} << 8 | raster[2 * i + 1] : raster[i];
    }
    if (value > header.maxval) return false;
    put(i, value);
  }
  if (!header.plain()) cursor.skip(header.min_raster_bytes());
  return true;
}

/// How values in [0, maxval] become samples: those of 2^n - 1 keep their upper bits, others are
/// scaled to the smallest depth that holds them, at most 12 bits, so that maxval becomes white.
class PnmScale {
 public:
  explicit PnmScale(uint32_t maxval)
      : maxval_(maxval),
        bits_(static_cast<int>(std::bit_width(maxval))),
        exact_(maxval >= 255 && std::has_single_bit(maxval + 1)) {}

  int depth() const { return std::clamp(bits_, 8, 12); }

  uint16_t sample(uint32_t value) const {
    if (exact_) return static_cast<uint16_t>(value >> (bits_ - depth()));
    return static_cast<uint16_t>((value * white() + maxval_ / 2) / maxval_);  // below 2^29
  }

  void note(const ImageSource& source, const RgbImage& image) const {
    if (exact_) return source.note_depth(bits_, image);
    source.note("samples of 0 to " + std::to_string(maxval_) + " are scaled to 0 to " +
                std::to_string(white()));
  }

 private:
  uint32_t white() const { return (uint32_t{1} << depth()) - 1; }

  uint32_t maxval_;
  int bits_;
  bool exact_;
};

}  // namespace

bool is_pnm(std::span<const uint8_t> bytes) {
  constexpr std::string_view kKinds = "1234567fF";
  return bytes.size() >= 3 && bytes[0] == 'P' && (is_space(bytes[2]) || bytes[2] == '#') &&
         kKinds.find(static_cast<char>(bytes[1])) != kKinds.npos;
}

IoResult<RgbImage> read_pnm(const ImageSource& source) {
  const auto kind = static_cast<char>(source.bytes[1]);
  if (kind == '1' || kind == '4') return unsupported(source, "PBM: a bitmap of black and white");
  if (kind == '7') return unsupported(source, "PAM", "convert it to PNG or PPM");
  if (kind == 'f' || kind == 'F') {
    return unsupported(source, "PFM: floating-point samples", "convert it to a PNG of 16 bits");
  }
  PnmCursor cursor(source.bytes);
  const auto header = read_header(source, cursor);
  if (!header) return tl::unexpected(header.error());
  if (!cursor.one_space() || cursor.rest().size() < header->min_raster_bytes()) {
    return damaged(source, "PNM: the file ends before the picture does");
  }
  cursor.skip_line_feed(header->min_raster_bytes());
  const PnmScale scale(header->maxval);
  auto image = allocate_image(source, header->width, header->height, scale.depth());
  if (!image) return image;

  uint16_t* samples = image->samples.data();
  const bool grey = header->channels() == 1;
  const bool complete = read_values(*header, cursor, [&](uint64_t index, uint32_t value) {
    const uint16_t sample = scale.sample(value);
    if (grey) {
      std::fill_n(samples + 3 * index, 3, sample);
    } else {
      samples[index] = sample;
    }
  });
  if (!complete) {
    return damaged(source, "PNM: a sample is missing or over the greatest value " +
                               std::to_string(header->maxval));
  }
  scale.note(source, *image);
  cursor.skip_blanks();
  source.note_surplus(cursor.rest().size());
  return image;
}

}  // namespace hmlfc::io
