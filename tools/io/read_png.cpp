// PNG through libpng. libpng reports errors by longjmp: every call that can fail happens inside
// guarded(), in functions whose own locals need no destructor.
#include <png.h>
#include <cerrno>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

struct PngInput {
  std::span<const uint8_t> rest;
  char message[128] = "unknown error";
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

void ignore_warning(png_structp, png_const_charp) {}

/// A libpng reader and its memory.
class PngReader {
 public:
  explicit PngReader(std::span<const uint8_t> bytes) {
    input_.rest = bytes;
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, keep_message, ignore_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool ready() const { return info_ != nullptr; }
  png_structp png() const { return png_; }
  png_infop info() const { return info_; }
  std::string message() const { return input_.message; }
  void attach_input() { png_set_read_fn(png_, &input_, take_bytes); }

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

/// Of the optional chunks only sBIT is read: the others carry nothing that an RgbImage holds, and
/// compressed ones could expand without bound.
void read_header(PngReader& reader) {
  png_structp png = reader.png();
  reader.attach_input();
  png_set_user_limits(png, kMaxSide, kMaxSide);
  png_set_benign_errors(png, 0);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  const png_byte significant_bits[] = "sBIT";
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, significant_bits, 1);
  png_read_info(png, reader.info());
}

/// Asks for R, G, B of 8 or 16 bits whatever is stored.
void choose_output(PngReader& reader) {
  png_structp png = reader.png();
  png_set_palette_to_rgb(png);
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

/// Rows of 8 or big-endian 16 bits a sample, from the front of `image.samples`' own memory, where
/// libpng has put them, to samples. Runs backwards for 8 bits, where the samples grow.
void widen_rows(RgbImage& image, bool wide) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(image.samples.data());
  const size_t count = image.samples.size();
  if (wide) {
    const int shift = 16 - image.depth;
    for (size_t i = 0; i < count; ++i) {
      const uint32_t value = uint32_t{bytes[2 * i]} << 8 | bytes[2 * i + 1];
      image.samples[i] = static_cast<uint16_t>(value >> shift);
    }
  } else {
    for (size_t i = count; i-- > 0;) image.samples[i] = bytes[i];
  }
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
  png_read_end(png, nullptr);
}

/// Deflate expands at most 1032 times, so a short file cannot hold a large picture.
bool can_hold(size_t file_bytes, uint64_t pixels, uint64_t bits_per_pixel) {
  constexpr uint64_t kMaxExpansion = 1032;
  return pixels * bits_per_pixel / 8 / kMaxExpansion <= file_bytes;
}

}  // namespace

bool is_png(std::span<const uint8_t> bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

IoResult<RgbImage> read_png(const ImageSource& source) {
  errno = 0;  // the C library sets it where it cannot allocate
  PngReader reader(source.bytes);
  if (!reader.ready()) return memory_error(source.path, "to read a PNG picture");
  const auto damaged = [&] {
    if (errno == ENOMEM) return memory_error(source.path, "to read a PNG picture");
    return file_error(source.path, "PNG: " + reader.message() + "; the file is damaged");
  };
  if (!reader.guarded([&] { read_header(reader); })) return damaged();

  const uint64_t width = png_get_image_width(reader.png(), reader.info());
  const uint64_t height = png_get_image_height(reader.png(), reader.info());
  const uint64_t stored_bits = uint64_t{png_get_bit_depth(reader.png(), reader.info())} *
                               png_get_channels(reader.png(), reader.info());
  if (!can_hold(source.bytes.size(), width * height, stored_bits)) {
    return file_error(source.path,
                      "PNG: the file is too short for its picture's size; it is damaged");
  }
  const int depth = std::clamp(significant_bits(reader), 8, 12);
  source.note_depth(significant_bits(reader));
  if ((png_get_color_type(reader.png(), reader.info()) & PNG_COLOR_MASK_ALPHA) != 0) {
    source.note("the alpha channel is dropped");
  }
  auto image = allocate_image(source, width, height, depth);
  if (!image) return image;

  if (!reader.guarded([&] { choose_output(reader); })) return damaged();
  const bool wide = png_get_bit_depth(reader.png(), reader.info()) == 16;
  if (png_get_rowbytes(reader.png(), reader.info()) != width * 3 * (wide ? 2 : 1)) {
    return file_error(source.path, "PNG: a pixel layout that is not supported; convert it to RGB");
  }
  if (!reader.guarded([&] { read_rows(reader, *image); })) return damaged();
  widen_rows(*image, wide);
  return image;
}

}  // namespace hmlfc::io
