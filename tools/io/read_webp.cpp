// WebP through libwebp, of both codings.
#include <webp/decode.h>
#include <webp/demux.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

/// The bytes of the first chunk `name`, which lie in the file; none where there is no such chunk.
std::span<const uint8_t> chunk(const WebPDemuxer* demuxer, const char* name) {
  WebPChunkIterator found;
  if (WebPDemuxGetChunk(demuxer, name, 1, &found) == 0) return {};
  const std::span<const uint8_t> bytes(found.chunk.bytes, found.chunk.size);
  WebPDemuxReleaseChunkIterator(&found);
  return bytes;
}

/// Rows of bytes into the front of the image's own memory.
VP8StatusCode decode_rows(const ImageSource& source, RgbImage& image) {
  WebPDecoderConfig config;
  WebPInitDecoderConfig(&config);
  const size_t row_bytes = size_t{image.width} * 3;
  config.output.colorspace = MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {reinterpret_cast<uint8_t*>(image.samples.data()),
                          static_cast<int>(row_bytes), row_bytes * image.height};
  return WebPDecode(source.bytes.data(), source.bytes.size(), &config);
}

}  // namespace

bool is_webp(std::span<const uint8_t> bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

IoResult<RgbImage> read_webp(const ImageSource& source) {
  const WebPData data{source.bytes.data(), source.bytes.size()};
  const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> demuxer(WebPDemux(&data),
                                                                         WebPDemuxDelete);
  WebPBitstreamFeatures features;
  const VP8StatusCode status = WebPGetFeatures(source.bytes.data(), source.bytes.size(), &features);
  if (demuxer == nullptr || status != VP8_STATUS_OK) {
    return damaged(source, "WebP: its chunks are wrong, or end before the picture does");
  }
  if (features.has_animation != 0) return unsupported(source, "WebP: an animation");
  if (features.has_alpha != 0) source.note("the alpha channel is dropped");
  source.note_profile(chunk(demuxer.get(), "ICCP"));
  uint32_t riff_bytes = 0;
  for (size_t i = 4; i > 0; --i) riff_bytes = riff_bytes << 8 | source.bytes[3 + i];
  source.note_surplus(source.bytes.size() -
                      std::min<size_t>(source.bytes.size(), size_t{riff_bytes} + 8));

  auto image = allocate_image(source, static_cast<uint64_t>(features.width),
                              static_cast<uint64_t>(features.height), 8);
  if (!image) return image;
  switch (decode_rows(source, *image)) {
    case VP8_STATUS_OK:
      break;
    case VP8_STATUS_OUT_OF_MEMORY:
      return memory_error(source.path, "to read a WebP picture");
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      return unsupported(source, "WebP: a feature that libwebp does not read");
    default:
      return damaged(source, "WebP: the coded picture is wrong or ends early");
  }
  widen_bytes(*image);
  return upright(source, std::move(*image), exif_orientation(chunk(demuxer.get(), "EXIF")));
}

}  // namespace hmlfc::io
