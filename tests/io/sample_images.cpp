#include "io/sample_images.hpp"

#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <span>
#include <stdexcept>

namespace hmlfc::test {
namespace {

void append(png_structp png, png_bytep data, size_t count) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), data, data + count);
}

[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }

void set_palette(png_structp png, png_infop info, const PngContent& content) {
  std::vector<png_color> colours;
  for (size_t i = 0; i < content.palette.size(); i += 3) {
    colours.push_back({content.palette[i], content.palette[i + 1], content.palette[i + 2]});
  }
  png_set_PLTE(png, info, colours.data(), static_cast<int>(colours.size()));
  if (!content.palette_alpha.empty()) {
    png_set_tRNS(png, info, content.palette_alpha.data(),
                 static_cast<int>(content.palette_alpha.size()), nullptr);
  }
}

}  // namespace

RgbImage random_image(uint32_t width, uint32_t height, int depth, uint32_t seed) {
  RgbImage image{width, height, depth, {}};
  std::mt19937 random(seed);
  const uint32_t levels = 1u << depth;
  image.samples.resize(size_t{width} * height * 3);
  for (uint16_t& sample : image.samples) sample = static_cast<uint16_t>(random() % levels);
  image.samples.front() = 0;
  image.samples.back() = static_cast<uint16_t>(levels - 1);
  return image;
}

Bytes make_png(const PngContent& content) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, content.width, content.height, content.bit_depth, content.colour_type,
               content.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (content.colour_type == PNG_COLOR_TYPE_PALETTE) set_palette(png, info, content);
  png_write_info(png, info);
  if (!content.significant.empty()) {
    const png_byte name[] = "sBIT";  // written raw: libpng would refuse odd counts
    png_write_chunk(png, name, content.significant.data(), content.significant.size());
  }
  const int passes = png_set_interlace_handling(png);
  const size_t row_bytes = content.rows.size() / content.height;
  for (int pass = 0; pass < passes; ++pass) {
    for (size_t y = 0; y < content.height; ++y) {
      png_write_row(png, content.rows.data() + y * row_bytes);
    }
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

Bytes stored_rows(const Bytes& png_file) {
  std::span<const uint8_t> rest = png_file;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &rest, [](png_structp reader, png_bytep out, size_t count) {
    auto& bytes = *static_cast<std::span<const uint8_t>*>(png_get_io_ptr(reader));
    std::copy_n(bytes.begin(), count, out);
    bytes = bytes.subspan(count);
  });
  png_read_info(png, info);
  const size_t row_bytes = png_get_rowbytes(png, info);
  Bytes rows(row_bytes * png_get_image_height(png, info));
  for (size_t start = 0; start < rows.size(); start += row_bytes) {
    png_read_row(png, rows.data() + start, nullptr);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return rows;
}

Bytes make_jpeg(const JpegContent& content) {
  jpeg_compress_struct encoder = {};
  jpeg_error_mgr errors = {};
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &data, &size);
  encoder.image_width = content.width;
  encoder.image_height = content.height;
  encoder.input_components = content.channels;
  encoder.in_color_space =
      content.channels == 1 ? JCS_GRAYSCALE : (content.channels == 3 ? JCS_RGB : JCS_CMYK);
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, 100, TRUE);
  if (content.full_chroma) {
    encoder.comp_info[0].h_samp_factor = 1;
    encoder.comp_info[0].v_samp_factor = 1;
  }
  if (content.progressive) jpeg_simple_progression(&encoder);
  jpeg_start_compress(&encoder, TRUE);
  const size_t row_bytes = size_t{content.width} * static_cast<size_t>(content.channels);
  Bytes pixels = content.pixels;
  while (encoder.next_scanline < encoder.image_height) {
    JSAMPROW row = pixels.data() + encoder.next_scanline * row_bytes;
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  jpeg_destroy_compress(&encoder);
  Bytes bytes(data, data + size);
  std::free(data);
  return bytes;
}

}  // namespace hmlfc::test
