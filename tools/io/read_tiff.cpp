// TIFF through libtiff: grey and RGB of 8 or 16 bits, in strips or tiles of the codings whose
// results are no longer than kMaxExpansion times their bytes.
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

constexpr uint64_t kMaxExpansion = 4096;        // of LZW, the greatest
constexpr uint64_t kSmall = uint64_t{1} << 26;  // bytes that are no burden
constexpr uint16_t kMaxChannels = 16;
constexpr uint16_t kNoColours = 0xFFFF;

/// The file as libtiff reads it, and the last error or warning that it gave of it.
struct TiffInput {
  std::span<const uint8_t> bytes;
  uint64_t position = 0;
  char message[256] = "";

  static TiffInput& of(thandle_t handle) { return *static_cast<TiffInput*>(handle); }
};

tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  TiffInput& input = TiffInput::of(handle);
  if (input.position >= input.bytes.size()) return 0;
  const auto rest = input.bytes.subspan(static_cast<size_t>(input.position));
  const size_t given = std::min(rest.size(), static_cast<size_t>(count));
  std::memcpy(out, rest.data(), given);
  input.position += given;
  return static_cast<tmsize_t>(given);
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
  TiffInput& input = TiffInput::of(handle);
  if (from == SEEK_CUR) offset += input.position;
  if (from == SEEK_END) offset += input.bytes.size();
  return input.position = offset;
}

int keep_message(TIFF*, void* handle, const char*, const char* format, va_list arguments) {
  TiffInput& input = TiffInput::of(handle);
  std::vsnprintf(input.message, sizeof(input.message), format, arguments);
  constexpr std::string_view kNoLine = " at scanline 4294967295";  // what libtiff says of a strip
  if (char* at = std::strstr(input.message, kNoLine.data())) {
    std::memmove(at, at + kNoLine.size(), std::strlen(at + kNoLine.size()) + 1);
  }
  return 1;
}

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

/// Errors and warnings go to `input` alone; what libtiff allocates by the file's numbers is
/// limited.
Tiff open_tiff(TiffInput& input) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) return {nullptr, TIFFClose};
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, &input);
  TIFFOpenOptionsSetWarningHandlerExtR(options, keep_message, &input);
  TIFFOpenOptionsSetMaxSingleMemAlloc(
      options, static_cast<tmsize_t>(std::max<uint64_t>(input.bytes.size(), kSmall)));
  TIFF* tiff = TIFFClientOpenExt(
      "TIFF", "rm", &input, read_bytes, [](thandle_t, void*, tmsize_t) -> tmsize_t { return 0; },
      seek, [](thandle_t) { return 0; },
      [](thandle_t handle) -> toff_t { return TiffInput::of(handle).bytes.size(); }, nullptr,
      nullptr, options);
  TIFFOpenOptionsFree(options);
  return {tiff, TIFFClose};
}

/// The number of tag `tag`, or its default; `missing` where it has none.
template <class T>
T field(TIFF* tiff, uint32_t tag, T missing = 0) {
  T value = missing;
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

/// How the samples stand in the file. A piece is a tile, or a strip of the picture's full width.
struct Layout {
  explicit Layout(TIFF* tiff)
      : width(field<uint32_t>(tiff, TIFFTAG_IMAGEWIDTH)),
        height(field<uint32_t>(tiff, TIFFTAG_IMAGELENGTH)),
        bits(field<uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE)),
        channels(field<uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL)),
        format(field<uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT)),
        colours(field(tiff, TIFFTAG_PHOTOMETRIC, kNoColours)),
        coding(field<uint16_t>(tiff, TIFFTAG_COMPRESSION)),
        planar(field<uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE),
        tiled(TIFFIsTiled(tiff) != 0),
        piece_width(tiled ? field<uint32_t>(tiff, TIFFTAG_TILEWIDTH) : width),
        piece_height(tiled ? field<uint32_t>(tiff, TIFFTAG_TILELENGTH)
                           : std::min(height, field<uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP))) {}

  bool grey() const { return colours == PHOTOMETRIC_MINISBLACK || inverted(); }
  bool inverted() const { return colours == PHOTOMETRIC_MINISWHITE; }
  uint16_t used_channels() const { return grey() ? 1 : 3; }
  uint16_t channels_of_piece() const { return planar ? 1 : channels; }
  uint64_t piece_row_bytes() const {
    return uint64_t{piece_width} * channels_of_piece() * (bits / 8);
  }
  bool is_supported() const {
    const bool plain = coding == COMPRESSION_NONE || coding == COMPRESSION_LZW ||
                       coding == COMPRESSION_ADOBE_DEFLATE || coding == COMPRESSION_DEFLATE ||
                       coding == COMPRESSION_PACKBITS;
    return (bits == 8 || bits == 16) && format == SAMPLEFORMAT_UINT &&
           (grey() || colours == PHOTOMETRIC_RGB) && channels >= used_channels() &&
           channels <= kMaxChannels && (plain || coding == COMPRESSION_JPEG);
  }

  uint32_t width, height;
  uint16_t bits, channels, format, colours, coding;
  bool planar, tiled;
  uint32_t piece_width, piece_height;
};

/// One piece after the other, from libtiff into the image.
class PieceReader {
 public:
  PieceReader(TIFF* tiff, const Layout& layout, RgbImage& image)
      : tiff_(tiff),
        layout_(layout),
        image_(image),
        piece_(static_cast<size_t>(layout.piece_row_bytes() * layout.piece_height)) {}

  /// False where libtiff reports that one is damaged.
  bool read_all() {
    const auto planes = static_cast<uint16_t>(layout_.planar ? layout_.used_channels() : 1);
    for (uint16_t plane = 0; plane < planes; ++plane) {
      for (uint32_t y = 0; y < layout_.height; y += layout_.piece_height) {
        for (uint32_t x = 0; x < layout_.width; x += layout_.piece_width) {
          if (!read_piece(x, y, plane)) return false;
          const auto end =
              static_cast<uint16_t>(layout_.planar ? plane + 1 : layout_.used_channels());
          for (uint16_t channel = plane; channel < end; ++channel) {
            place(x, y, channel, static_cast<uint16_t>(channel - plane));
          }
        }
      }
    }
    return true;
  }

 private:
  bool read_piece(uint32_t x, uint32_t y, uint16_t plane) {
    auto bytes = static_cast<tmsize_t>(piece_.size());
    if (layout_.tiled) return TIFFReadTile(tiff_, piece_.data(), x, y, 0, plane) == bytes;
    const uint32_t rows = std::min(layout_.piece_height, layout_.height - y);
    bytes = static_cast<tmsize_t>(layout_.piece_row_bytes() * rows);
    const uint32_t strip = TIFFComputeStrip(tiff_, y, plane);
    return TIFFReadEncodedStrip(tiff_, strip, piece_.data(), bytes) == bytes;
  }

  uint16_t sample(size_t index) const {
    uint16_t value = piece_[index];
    if (layout_.bits == 16) std::memcpy(&value, piece_.data() + 2 * index, 2);
    if (layout_.inverted())
      value = static_cast<uint16_t>((layout_.bits == 16 ? 65535 : 255) - value);
    return static_cast<uint16_t>(value >> (layout_.bits - image_.depth));
  }

  /// Channel `channel` of the picture, which is number `at` of the piece at (x, y).
  void place(uint32_t x, uint32_t y, uint16_t channel, uint16_t at) {
    const uint32_t columns = std::min(layout_.piece_width, layout_.width - x);
    const uint32_t rows = std::min(layout_.piece_height, layout_.height - y);
    for (uint32_t row = 0; row < rows; ++row) {
      size_t from = size_t{row} * layout_.piece_width * layout_.channels_of_piece() + at;
      uint16_t* out = image_.samples.data() + (size_t{y + row} * layout_.width + x) * 3 + channel;
      for (uint32_t i = 0; i < columns; ++i, from += layout_.channels_of_piece(), out += 3) {
        std::fill_n(out, layout_.grey() ? 3 : 1, sample(from));
      }
    }
  }

  TIFF* tiff_;
  const Layout& layout_;
  RgbImage& image_;
  std::vector<uint8_t> piece_;
};

/// What the picture has besides its samples.
void note_remarks(const ImageSource& source, TIFF* tiff, const Layout& layout,
                  const RgbImage& image) {
  source.note_depth(layout.bits, image);
  if (layout.channels > layout.used_channels()) source.note("the alpha channel is dropped");
  if (TIFFLastDirectory(tiff) == 0) source.note("only the first picture of the file is read");
  uint32_t count = 0;
  const void* profile = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &count, &profile) == 1) {
    source.note_profile({static_cast<const uint8_t*>(profile), count});
  }
}

/// Why the picture is not read, if so.
std::optional<IoError> refusal(const ImageSource& source, TIFF* tiff, const Layout& layout) {
  if ((field<uint32_t>(tiff, TIFFTAG_SUBFILETYPE) & FILETYPE_REDUCEDIMAGE) != 0) {
    return unsupported(source, "TIFF: its first picture is only a preview").value();
  }
  if (!layout.is_supported()) {
    return unsupported(source,
                       fmt::format("TIFF: {} samples of {} bits a pixel, SampleFormat {}, "
                                   "PhotometricInterpretation {}, Compression {}",
                                   layout.channels, layout.bits, layout.format, layout.colours,
                                   layout.coding),
                       "convert it to grey or RGB of 8 or 16 bits without compression, or to PNG")
        .value();
  }
  const uint64_t pixels =
      uint64_t{std::min(layout.width, kMaxSide)} * std::min(layout.height, kMaxSide);
  const uint64_t most = std::max(kSmall, pixels * kMaxChannels * 2);
  if (layout.piece_height == 0 || layout.piece_row_bytes() > most / layout.piece_height ||
      layout.piece_width == 0 || pixels / kMaxExpansion > source.bytes.size()) {
    return damaged(source, "TIFF: the file is too short for its picture's size").value();
  }
  return std::nullopt;
}

}  // namespace

bool is_tiff(std::span<const uint8_t> bytes) {
  constexpr uint8_t kMarks[4][4] = {
      {'I', 'I', 42, 0}, {'M', 'M', 0, 42}, {'I', 'I', 43, 0}, {'M', 'M', 0, 43}};
  return bytes.size() >= 4 && std::ranges::any_of(kMarks, [&](const auto& mark) {
           return std::memcmp(bytes.data(), mark, 4) == 0;
         });
}

IoResult<RgbImage> read_tiff(const ImageSource& source) {
  TiffInput input{source.bytes};
  const Tiff tiff = open_tiff(input);
  if (tiff == nullptr) return damaged(source, fmt::format("TIFF: {}", input.message));
  Layout layout(tiff.get());
  const bool jpeg = layout.coding == COMPRESSION_JPEG;
  if (jpeg && layout.colours == PHOTOMETRIC_YCBCR && !layout.planar) {
    TIFFSetField(tiff.get(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    layout.colours = PHOTOMETRIC_RGB;
  }
  if (auto reason = refusal(source, tiff.get(), layout)) return tl::unexpected(*reason);
  auto image = allocate_image(source, layout.width, layout.height, layout.bits == 16 ? 12 : 8);
  if (!image) return image;
  std::strcpy(input.message, "");  // warnings until here were of tags that libtiff does not know
  try {
    const bool whole = PieceReader(tiff.get(), layout, *image).read_all();
    const std::string_view message = input.message;
    if (!whole || (jpeg && !message.empty())) {  // libjpeg only warns where it makes samples up
      return damaged(source,
                     fmt::format("TIFF: {}", message.empty() ? "a strip is short" : message));
    }
  } catch (const std::bad_alloc&) {
    return memory_error(source.path, "to read a TIFF picture");
  }
  note_remarks(source, tiff.get(), layout, *image);
  return upright(source, std::move(*image), field<uint16_t>(tiff.get(), TIFFTAG_ORIENTATION));
}

}  // namespace hmlfc::io
