// PNG through libpng, into memory first. As in read_png.cpp, libpng's longjmp only crosses
// functions whose locals need no destructor.
#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/encode_png.hpp"
#include "io/write_image.hpp"

namespace hmlfc::io {
namespace {

// Level 1 with one fixed filter writes photographs about eight times as fast as libpng's defaults,
// for about a sixth more bytes.
constexpr int kCompressionLevel = 1;

struct PngOutput {
  std::vector<uint8_t> bytes;
  bool out_of_memory = false;
};

void append_bytes(png_structp png, png_bytep data, size_t count) {
  auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
  try {
    output.bytes.insert(output.bytes.end(), data, data + count);
  } catch (const std::bad_alloc&) {
    output.out_of_memory = true;
  }
  if (output.out_of_memory) png_error(png, "out of memory");
}

[[noreturn]] void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }

void ignore_warning(png_structp, png_const_charp) {}

/// The 8 or big-endian 16 bits of each sample of one pixel row.
void pack_row(const RgbImage& image, size_t y, uint8_t* out) {
  const size_t count = size_t{image.width} * 3;
  const uint16_t* row = image.samples.data() + y * count;
  const int depth = image.depth;
  for (size_t i = 0; i < count; ++i) {
    if (depth == 8) {
      out[i] = static_cast<uint8_t>(row[i]);
      continue;
    }
    const uint32_t value = uint32_t{row[i]} << (16 - depth) | uint32_t{row[i]} >> (2 * depth - 16);
    out[2 * i] = static_cast<uint8_t>(value >> 8);
    out[2 * i + 1] = static_cast<uint8_t>(value);
  }
}

void write_header(png_structp png, png_infop info, const RgbImage& image) {
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_compression_level(png, kCompressionLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, image.width, image.height, image.depth == 8 ? 8 : 16, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (image.depth > 8) {
    const auto bits = static_cast<png_byte>(image.depth);
    const png_color_8 significant = {bits, bits, bits, 0, 0};
    png_set_sBIT(png, info, &significant);
  }
  png_write_info(png, info);
}

/// False where libpng reported an error; `row` has room for one packed row.
bool encode(png_structp png, png_infop info, const RgbImage& image, uint8_t* row) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  write_header(png, info, image);
  for (size_t y = 0; y < image.height; ++y) {
    pack_row(image, y, row);
    png_write_row(png, row);
  }
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::vector<uint8_t> encode_png(const RgbImage& image) {
  PngOutput output;
  std::vector<uint8_t> row(size_t{image.width} * 3 * (image.depth == 8 ? 1 : 2));
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, give_up, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info != nullptr) {
    png_set_write_fn(png, &output, append_bytes, nullptr);
    done = encode(png, info, image, row.data());
  }
  png_destroy_write_struct(&png, &info);
  if (!done) output.bytes.clear();
  return std::move(output.bytes);
}

IoResult<void> write_png(const std::filesystem::path& path, const RgbImage& image) {
  const std::vector<uint8_t> bytes = encode_png(image);
  if (bytes.empty()) return file_error(path, "not enough memory to write a PNG picture");
  return write_file(path, bytes);
}

}  // namespace hmlfc::io
