// JPEG through libjpeg-turbo. The library reports errors by a function that must not return; ours
// longjmps back into guarded(), and functions called there have no locals with destructors.
#include <cerrno>
#include <cstddef>
#include <cstdio>  // jpeglib.h uses FILE and size_t without including them

#include <jpeglib.h>

#include <jerror.h>

#include <csetjmp>
#include <string>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

constexpr int kMaxScans = 500;  // a hostile progressive file can repeat scans for hours

struct JpegErrors {
  jpeg_error_mgr base;  // first: libjpeg knows the object by this address
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void stop(j_common_ptr common) {
  auto& errors = *reinterpret_cast<JpegErrors*>(common->err);
  common->err->format_message(common, errors.message);
  std::longjmp(errors.escape, 1);
}

/// A warning (level -1) means that data was missing or made up: as bad as an error here. Two kinds
/// leave the picture whole: stray bytes between markers, and an odd JFIF version number.
void stop_at_damage(j_common_ptr common, int level) {
  const int code = common->err->msg_code;
  if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR) stop(common);
}

void limit_scans(j_common_ptr common) {
  const auto* decoder = reinterpret_cast<jpeg_decompress_struct*>(common);
  if (decoder->input_scan_number > kMaxScans) {
    common->err->msg_code = JERR_BAD_PROGRESSION;
    stop(common);
  }
}

class JpegReader {
 public:
  JpegReader() {
    decoder_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = stop;
    errors_.base.emit_message = stop_at_damage;
    monitor_.progress_monitor = limit_scans;
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&decoder_); }

  jpeg_decompress_struct& decoder() { return decoder_; }
  std::string message() const { return errors_.message; }
  void attach_monitor() { decoder_.progress = &monitor_; }

  /// Runs `body`; false where libjpeg reported an error in it.
  template <class Body>
  bool guarded(const Body& body) {
    if (setjmp(errors_.escape) != 0) return false;
    body();
    return true;
  }

 private:
  JpegErrors errors_ = {};
  jpeg_progress_mgr monitor_ = {};
  jpeg_decompress_struct decoder_ = {};
};

void read_header(JpegReader& reader, std::span<const uint8_t> bytes) {
  jpeg_create_decompress(&reader.decoder());
  reader.attach_monitor();
  jpeg_mem_src(&reader.decoder(), bytes.data(), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&reader.decoder(), TRUE);
}

/// Rows of bytes into the front of the image's own memory, to the end marker.
void read_rows(JpegReader& reader, RgbImage& image) {
  jpeg_decompress_struct& decoder = reader.decoder();
  decoder.out_color_space = JCS_RGB;
  decoder.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&decoder);
  auto* first = reinterpret_cast<JSAMPLE*>(image.samples.data());
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row = first + size_t{decoder.output_scanline} * image.width * 3;
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
}

/// From bytes to samples in the same memory, backwards as the samples grow.
void widen(RgbImage& image) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(image.samples.data());
  for (size_t i = image.samples.size(); i-- > 0;) image.samples[i] = bytes[i];
}

/// Every 8 x 8 block of the finest component takes at least one bit (Huffman coding).
bool can_hold(const ImageSource& source, const jpeg_decompress_struct& decoder) {
  const uint64_t blocks =
      (uint64_t{decoder.image_width} / 8) * (uint64_t{decoder.image_height} / 8);
  return decoder.arith_code != FALSE || blocks / 8 <= source.bytes.size();
}

}  // namespace

bool is_jpeg(std::span<const uint8_t> bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

IoResult<RgbImage> read_jpeg(const ImageSource& source) {
  JpegReader reader;
  errno = 0;  // the C library sets it where it cannot allocate
  const auto damaged = [&] {
    if (errno == ENOMEM) return memory_error(source.path, "to read a JPEG picture");
    return file_error(source.path, "JPEG: " + reader.message() + "; the file is damaged");
  };
  if (!reader.guarded([&] { read_header(reader, source.bytes); })) return damaged();
  const jpeg_decompress_struct& decoder = reader.decoder();
  if (decoder.jpeg_color_space == JCS_CMYK || decoder.jpeg_color_space == JCS_YCCK ||
      decoder.jpeg_color_space == JCS_UNKNOWN) {
    return file_error(source.path, "JPEG: not grey, RGB or YCbCr; convert it to RGB");
  }
  if (!can_hold(source, decoder)) {
    return file_error(source.path,
                      "JPEG: the file is too short for its picture's size; it is damaged");
  }
  auto image = allocate_image(source, decoder.image_width, decoder.image_height, 8);
  if (!image) return image;
  if (!reader.guarded([&] { read_rows(reader, *image); })) return damaged();
  widen(*image);
  return image;
}

}  // namespace hmlfc::io
