#include "io/sample_images.hpp"

#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>

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

/// A chunk of RIFF: name, length, content, and a zero after an odd length.
void append_chunk(Bytes& file, const std::string& name, const Bytes& content) {
  file.insert(file.end(), name.begin(), name.end());
  for (int i = 0; i < 4; ++i) file.push_back(static_cast<uint8_t>(content.size() >> (8 * i)));
  file.insert(file.end(), content.begin(), content.end());
  if (content.size() % 2 != 0) file.push_back(0);
}

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
  png_set_check_for_invalid_index(png, 0);  // samples may have what is wrong
  png_set_IHDR(png, info, content.width, content.height, content.bit_depth, content.colour_type,
               content.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (content.colour_type == PNG_COLOR_TYPE_PALETTE) set_palette(png, info, content);
  png_write_info(png, info);
  if (!content.significant.empty()) {
    const png_byte name[] = "sBIT";  // written raw: libpng would refuse odd counts
    png_write_chunk(png, name, content.significant.data(), content.significant.size());
  }
  for (const auto& [name, data] : content.chunks) {
    png_write_chunk(png, reinterpret_cast<png_const_bytep>(name.data()), data.data(), data.size());
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
  encoder.comp_info[0].h_samp_factor = content.h;
  encoder.comp_info[0].v_samp_factor = content.v;
  encoder.restart_interval = content.restart;
  if (content.adobe) {
    encoder.write_JFIF_header = FALSE;
    encoder.write_Adobe_marker = TRUE;
  }
  if (content.progressive) jpeg_simple_progression(&encoder);
  jpeg_start_compress(&encoder, TRUE);
  if (!content.exif.empty()) {
    jpeg_write_marker(&encoder, JPEG_APP0 + 1, content.exif.data(),
                      static_cast<unsigned>(content.exif.size()));
  }
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

Bytes make_exif(uint8_t orientation, const std::string& order) {
  if (order == "II") {
    return {'I', 'I', 42, 0, 8, 0,           0, 0, 1, 0, 0x12, 1, 3,
            0,   1,   0,  0, 0, orientation, 0, 0, 0, 0, 0,    0, 0};
  }
  return {'M', 'M', 0, 42, 0, 0, 0,           8, 0, 1, 1, 0x12, 0,
          3,   0,   0, 0,  1, 0, orientation, 0, 0, 0, 0, 0,    0};
}

Bytes make_webp(uint32_t width, uint32_t height, const Bytes& pixels, const Bytes& exif) {
  uint8_t* data = nullptr;
  const size_t size =
      WebPEncodeLosslessRGB(pixels.data(), static_cast<int>(width), static_cast<int>(height),
                            static_cast<int>(width) * 3, &data);
  Bytes file(data, data + size);
  WebPFree(data);
  if (exif.empty()) return file;
  // Flags, three bytes of zeros, width - 1 and height - 1 of three bytes each.
  Bytes chunks = {'W', 'E', 'B', 'P'};
  append_chunk(
      chunks, "VP8X",
      {8, 0, 0, 0, static_cast<uint8_t>(width - 1), 0, 0, static_cast<uint8_t>(height - 1), 0, 0});
  chunks.insert(chunks.end(), file.begin() + 12, file.end());
  append_chunk(chunks, "EXIF", exif);
  Bytes extended;
  append_chunk(extended, "RIFF", chunks);
  return extended;
}

}  // namespace hmlfc::test
