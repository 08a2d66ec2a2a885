// PNG through libpng. libpng reports errors by longjmp: every call that can fail happens inside
// guarded(), in functions whose own locals need no destructor.
#include <png.h>
#include <zlib.h>
#include <cerrno>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <string>
#include <string_view>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

/// What libpng reads, and what its callbacks, in which nothing may throw, found.
struct PngInput {
  std::span<const uint8_t> rest;
  char message[128] = "unknown error";
  char warning[128] = "";  ///< the first
  bool transparency = false;
  bool animation = false;
  int orientation = 1;
  std::array<uint8_t, 1 << 14> profile{};  ///< an ICC profile's beginning
  size_t profile_bytes = 0;
};

void take_bytes(png_structp png, png_bytep out, size_t count) {
  auto& input = *static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > input.rest.size()) png_error(png, "the file ends before the picture does");
  std::memcpy(out, input.rest.data(), count);
  input.rest = input.rest.subspan(count);
}

[[noreturn]] void keep_message(png_structp png, png_const_charp message) {
  auto& input = *static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(input.message, message, sizeof(input.message) - 1);
  png_longjmp(png, 1);
}

/// Warnings are of parts that carry no samples, but for those of the coded samples: of these only
/// surplus is harmless.
void take_warning(png_structp png, png_const_charp message) {
  const std::string_view text = message;
  if (text.starts_with("IDAT:") && text.find("Extra compressed") == text.npos &&
      text.find("Too much image") == text.npos) {
    keep_message(png, message);
  }
  auto& input = *static_cast<PngInput*>(png_get_error_ptr(png));
  if (*input.warning == '\0') std::strncpy(input.warning, message, sizeof(input.warning) - 1);
}

/// iCCP: a name, a zero, the method 0, and the profile, deflated.
void take_profile(PngInput& input, std::span<const uint8_t> chunk) {
  const auto name_end = std::ranges::find(chunk, uint8_t{0});
  const auto start = static_cast<size_t>(name_end - chunk.begin()) + 2;
  if (start >= chunk.size()) return;
  uLongf count = static_cast<uLongf>(input.profile.size());
  uncompress(input.profile.data(), &count, chunk.data() + start,
             static_cast<uLong>(chunk.size() - start));
  input.profile_bytes = count;
}

int take_chunk(png_structp png, png_unknown_chunkp chunk) {
  auto& input = *static_cast<PngInput*>(png_get_user_chunk_ptr(png));
  const std::span<const uint8_t> data(chunk->data, chunk->size);
  const std::string_view name(reinterpret_cast<const char*>(chunk->name), 4);
  if (name == "tRNS") input.transparency = true;
  if (name == "acTL" && data.size() == 8) input.animation = png_get_uint_32(data.data()) > 1;
  if (name == "eXIf") input.orientation = exif_orientation(data);
  if (name == "iCCP") take_profile(input, data);
  return name[0] >= 'a' ? 1 : 0;  // libpng refuses the critical ones that it does not know
}

/// A libpng reader and its memory.
class PngReader {
 public:
  explicit PngReader(std::span<const uint8_t> bytes) {
    input_.rest = bytes;
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, keep_message, take_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool ready() const { return info_ != nullptr; }
  png_structp png() const { return png_; }
  png_infop info() const { return info_; }
  const PngInput& input() const { return input_; }
  std::string message() const { return std::string("PNG: ") + input_.message; }
  void attach_input() {
    png_set_read_fn(png_, &input_, take_bytes);
    png_set_read_user_chunk_fn(png_, &input_, take_chunk);
  }

  /// Runs `body`; false where libpng reported an error in it.
  template <class Body>
  bool guarded(const Body& body) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    body();
    return true;
  }

 private:
  PngInput input_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

/// Of the optional chunks libpng reads only sBIT, and take_chunk() a few: the others carry nothing
/// that an RgbImage holds, and compressed ones could expand without bound.
void read_header(PngReader& reader) {
  png_structp png = reader.png();
  reader.attach_input();
  png_set_user_limits(png, 16 * kMaxSide, 16 * kMaxSide);
  png_set_benign_errors(png, 1);
  png_set_check_for_invalid_index(png, 0);  // look_up_colours() does
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  const png_byte transparency[] = "tRNS";
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, transparency, 1);
  const png_byte significant_bits[] = "sBIT";
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, significant_bits, 1);
  png_read_info(png, reader.info());
}

bool has_palette(const PngReader& reader) {
  return png_get_color_type(reader.png(), reader.info()) == PNG_COLOR_TYPE_PALETTE;
}

/// Asks for bytes that are indices of a palette, else for R, G, B of 8 or 16 bits.
void choose_output(PngReader& reader) {
  png_structp png = reader.png();
  png_set_packing(png);
  const int colour = png_get_color_type(png, reader.info());
  if (colour == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
  if ((colour & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info());
}

// Bits of the samples that carry information, as sBIT says; at most 8 where 8 or fewer are stored.
int significant_bits(const PngReader& reader) {
  const int stored = png_get_bit_depth(reader.png(), reader.info());
  png_color_8p bits = nullptr;
  if (stored < 16 || png_get_sBIT(reader.png(), reader.info(), &bits) == 0) return stored;
  const bool colour = (png_get_color_type(reader.png(), reader.info()) & PNG_COLOR_MASK_COLOR) != 0;
  return colour ? std::max({bits->red, bits->green, bits->blue}) : bits->gray;
}

/// Rows of big-endian 16 bits a sample, from the samples' own memory, to samples.
void narrow_rows(RgbImage& image) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(image.samples.data());
  const int shift = 16 - image.depth;
  for (size_t i = 0; i < image.samples.size(); ++i) {
    const uint32_t value = uint32_t{bytes[2 * i]} << 8 | bytes[2 * i + 1];
    image.samples[i] = static_cast<uint16_t>(value >> shift);
  }
}

/// From indices in the front of the samples' own memory to the palette's colours, backwards as they
/// grow. Where it has none, black, as PNG recommends; then false.
bool look_up_colours(const PngReader& reader, RgbImage& image) {
  bool complete = true;
  png_colorp colours = nullptr;
  int count = 0;
  png_get_PLTE(reader.png(), reader.info(), &colours, &count);
  const auto* indices = reinterpret_cast<const uint8_t*>(image.samples.data());
  for (size_t i = image.samples.size() / 3; i-- > 0;) {
    complete = complete && indices[i] < count;
    const png_color colour = indices[i] < count ? colours[indices[i]] : png_color{0, 0, 0};
    image.samples[3 * i] = colour.red;
    image.samples[3 * i + 1] = colour.green;
    image.samples[3 * i + 2] = colour.blue;
  }
  return complete;
}

/// All rows into the front of the image's own memory, then every check up to the file's end.
void read_rows(PngReader& reader, RgbImage& image) {
  png_structp png = reader.png();
  const size_t row_bytes = png_get_rowbytes(png, reader.info());
  auto* first = reinterpret_cast<png_bytep>(image.samples.data());
  const int passes = png_get_interlace_type(png, reader.info()) == PNG_INTERLACE_NONE ? 1 : 7;
  for (int pass = 0; pass < passes; ++pass) {
    for (size_t y = 0; y < image.height; ++y) png_read_row(png, first + y * row_bytes, nullptr);
  }
  png_read_end(png, reader.info());
}

/// Deflate expands at most 1032 times, so a short file cannot hold a large picture.
bool can_hold(size_t file_bytes, uint64_t pixels, uint64_t bits_per_pixel) {
  constexpr uint64_t kMaxExpansion = 1032;
  return pixels * bits_per_pixel / 8 / kMaxExpansion <= file_bytes;
}

void note_remarks(const ImageSource& source, const PngInput& input) {
  if (input.transparency) source.note("transparency (tRNS) is dropped");
  if (input.animation) source.note("only the first picture of the animation is read");
  if (*input.warning != '\0') {
    source.note(std::string("PNG: ") + input.warning + ": ignored, since it carries no samples");
  }
  source.note_profile(std::span(input.profile).first(input.profile_bytes));
  source.note_surplus(input.rest.size());
}

}  // namespace

bool is_png(std::span<const uint8_t> bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

IoResult<RgbImage> read_png(const ImageSource& source) {
  errno = 0;  // the C library sets it where it cannot allocate
  PngReader reader(source.bytes);
  if (!reader.ready()) return memory_error(source.path, "to read a PNG picture");
  const auto failed = [&]() -> IoResult<RgbImage> {
    if (errno == ENOMEM) return memory_error(source.path, "to read a PNG picture");
    if (reader.message().ends_with("unhandled critical chunk")) {
      return unsupported(source, reader.message(), "save it as an ordinary PNG");
    }
    return damaged(source, reader.message());
  };
  if (source.bytes.size() >= 16 && std::memcmp(source.bytes.data() + 12, "CgBI", 4) == 0) {
    return unsupported(source, "PNG: Apple's own form (CgBI)", "save it as an ordinary PNG");
  }
  if (!reader.guarded([&] { read_header(reader); })) return failed();

  const uint64_t width = png_get_image_width(reader.png(), reader.info());
  const uint64_t height = png_get_image_height(reader.png(), reader.info());
  const uint64_t stored_bits = uint64_t{png_get_bit_depth(reader.png(), reader.info())} *
                               png_get_channels(reader.png(), reader.info());
  if (!can_hold(source.bytes.size(), width * height, stored_bits)) {
    return damaged(source, "PNG: the file is too short for its picture's size");
  }
  if ((png_get_color_type(reader.png(), reader.info()) & PNG_COLOR_MASK_ALPHA) != 0) {
    source.note("the alpha channel is dropped");
  }
  auto image = allocate_image(source, width, height, std::clamp(significant_bits(reader), 8, 12));
  if (!image) return image;

  if (!reader.guarded([&] { choose_output(reader); })) return failed();
  const bool wide = png_get_bit_depth(reader.png(), reader.info()) == 16;
  const bool palette = has_palette(reader);
  if (png_get_rowbytes(reader.png(), reader.info()) != width * (palette ? 1 : wide ? 6 : 3)) {
    return unsupported(source, "PNG: its layout of pixels");
  }
  if (!reader.guarded([&] { read_rows(reader, *image); })) return failed();
  if (palette && !look_up_colours(reader, *image)) {
    source.note("pixels without a colour in the palette are black");
  }
  if (wide) {
    narrow_rows(*image);
    source.note_depth(significant_bits(reader), *image);
  }
  if (!palette && !wide) widen_bytes(*image);
  note_remarks(source, reader.input());
  return upright(source, std::move(*image), reader.input().orientation);
}

}  // namespace hmlfc::io
