// JPEG through libjpeg-turbo. The library reports errors by a function that must not return; ours
// longjmps back into guarded(), and functions called there have no locals with destructors.
#include <cerrno>
#include <cstddef>
#include <cstdio>  // jpeglib.h uses FILE and size_t without including them

#include <jpeglib.h>

#include <jerror.h>

#include <csetjmp>
#include <cstring>
#include <string>
#include <string_view>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

constexpr int kExif = 1;        // APP1
constexpr int kProfile = 2;     // APP2
constexpr int kMaxScans = 500;  // a hostile progressive file can repeat scans for hours

struct JpegErrors {
  jpeg_error_mgr base;  // first: libjpeg knows the object by this address
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX] = "";
  char warning[JMSG_LENGTH_MAX] = "";  ///< the first that leaves the samples as they are
};

[[noreturn]] void stop(j_common_ptr common) {
  auto& errors = *reinterpret_cast<JpegErrors*>(common->err);
  common->err->format_message(common, errors.message);
  std::longjmp(errors.escape, 1);
}

/// A warning (level -1) means that data was missing or made up, and is as bad as an error here, but
/// for those of fields that decide nothing, and of bytes between two markers. Before a restart
/// marker the latter are samples that were not understood.
void judge_warning(j_common_ptr common, int level) {
  if (level >= 0) return;
  const jpeg_error_mgr& base = *common->err;
  const int marker = base.msg_parm.i[1];
  const bool stray =
      base.msg_code == JWRN_EXTRANEOUS_DATA && (marker < JPEG_RST0 || marker > JPEG_RST0 + 7);
  if (!stray && base.msg_code != JWRN_JFIF_MAJOR && base.msg_code != JWRN_ADOBE_XFORM &&
      base.msg_code != JWRN_NOT_SEQUENTIAL) {
    stop(common);
  }
  auto& errors = *reinterpret_cast<JpegErrors*>(common->err);
  if (*errors.warning != '\0') return;
  if (stray) {
    std::strcpy(errors.warning, "stray bytes before a marker");  // without their number
  } else {
    base.format_message(common, errors.warning);
  }
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
    errors_.base.emit_message = judge_warning;
    monitor_.progress_monitor = limit_scans;
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&decoder_); }

  jpeg_decompress_struct& decoder() { return decoder_; }
  const jpeg_decompress_struct& decoder() const { return decoder_; }
  const JpegErrors& errors() const { return errors_; }
  std::string message() const { return std::string("JPEG: ") + errors_.message; }
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
  for (const int marker : {kExif, kProfile}) {
    jpeg_save_markers(&reader.decoder(), JPEG_APP0 + marker, 0xFFFF);
  }
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

/// Every 8 x 8 block of the finest component takes at least one bit (Huffman coding).
bool can_hold(const ImageSource& source, const jpeg_decompress_struct& decoder) {
  const uint64_t blocks =
      (uint64_t{decoder.image_width} / 8) * (uint64_t{decoder.image_height} / 8);
  return decoder.arith_code != FALSE || blocks / 8 <= source.bytes.size();
}

/// The content of the first marker APP`number` that starts with `name` and a zero; empty where
/// there is none.
std::span<const uint8_t> marker(const jpeg_decompress_struct& decoder, int number,
                                std::string_view name) {
  for (auto* saved = decoder.marker_list; saved != nullptr; saved = saved->next) {
    const std::span<const uint8_t> data(saved->data, saved->data_length);
    if (saved->marker == JPEG_APP0 + number && data.size() > name.size() &&
        data[name.size()] == 0 && std::memcmp(data.data(), name.data(), name.size()) == 0) {
      return data;
    }
  }
  return {};
}

/// Whether libjpeg's error is about a kind of JPEG that it does not read.
bool is_unsupported(const JpegReader& reader) {
  switch (reader.errors().base.msg_code) {
    case JERR_BAD_PRECISION:
      return reader.decoder().data_precision == 12;
    case JERR_EMPTY_IMAGE:  // the height stands after the samples (DNL)
      return reader.decoder().image_width > 0 && reader.decoder().num_components > 0;
    case JERR_UNKNOWN_MARKER:
      return reader.errors().base.msg_parm.i[0] == 0xF7;  // JPEG-LS
    case JERR_SOF_UNSUPPORTED:
    case JERR_ARITH_NOTIMPL:
    case JERR_CCIR601_NOTIMPL:
    case JERR_CONVERSION_NOTIMPL:
    case JERR_FRACT_SAMPLE_NOTIMPL:
    case JERR_IMAGE_TOO_BIG:
    case JERR_NOTIMPL:
    case JERR_NOT_COMPILED:
      return true;
    default:
      return false;
  }
}

void note_remarks(const ImageSource& source, const JpegReader& reader) {
  if (*reader.errors().warning != '\0') {
    source.note(std::string("JPEG: ") + reader.errors().warning +
                ": ignored, since it carries no samples");
  }
  source.note_surplus(reader.decoder().src->bytes_in_buffer);
}

}  // namespace

bool is_jpeg(std::span<const uint8_t> bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

IoResult<RgbImage> read_jpeg(const ImageSource& source) {
  JpegReader reader;
  errno = 0;  // the C library sets it where it cannot allocate
  const auto failed = [&]() -> IoResult<RgbImage> {
    if (errno == ENOMEM) return memory_error(source.path, "to read a JPEG picture");
    if (!is_unsupported(reader)) return damaged(source, reader.message());
    if (reader.decoder().data_precision == 12) {
      return unsupported(source, "JPEG: samples of 12 bits", "convert it to a PNG of 16 bits");
    }
    return unsupported(source, reader.message());
  };
  if (!reader.guarded([&] { read_header(reader, source.bytes); })) return failed();
  const jpeg_decompress_struct& decoder = reader.decoder();
  if (decoder.jpeg_color_space == JCS_CMYK || decoder.jpeg_color_space == JCS_YCCK ||
      decoder.jpeg_color_space == JCS_UNKNOWN) {
    return unsupported(source, "JPEG: CMYK, or other colours that are not grey, RGB or YCbCr",
                       "convert it to RGB");
  }
  if (!can_hold(source, decoder)) {
    return damaged(source, "JPEG: the file is too short for its picture's size");
  }
  // libjpeg forgets the markers with the end of the picture.
  source.note_profile(marker(decoder, kProfile, "ICC_PROFILE"));
  const int orientation = exif_orientation(marker(decoder, kExif, "Exif"));
  auto image = allocate_image(source, decoder.image_width, decoder.image_height, 8);
  if (!image) return image;
  if (!reader.guarded([&] { read_rows(reader, *image); })) return failed();
  widen_bytes(*image);
  note_remarks(source, reader);
  return upright(source, std::move(*image), orientation);
}

}  // namespace hmlfc::io
