#include <tiffio.h>

#include <algorithm>
#include <cstddef>

#include "io/sample_images.hpp"

namespace hmlfc::test {
namespace {

/// A tile, or a strip of the picture's full width.
struct Piece {
  uint32_t left, top, width, height;
};

void set_fields(TIFF* tiff, const TiffContent& content, const Piece& piece) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, content.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, content.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, content.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, content.channels);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, content.colours);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, content.coding);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, content.planes);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, content.orientation);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, content.format);
  TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, content.subfile);
  if (content.tile > 0) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, piece.width);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, piece.height);
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, piece.height);
  }
}

void write_piece(TIFF* tiff, const TiffContent& content, const Piece& piece, uint16_t plane) {
  const size_t channels = content.planes == 2 ? 1 : content.channels;
  std::vector<uint16_t> words(size_t{piece.width} * piece.height * channels);
  for (size_t i = 0; i < words.size(); ++i) {
    const size_t x = piece.left + i / channels % piece.width;
    const size_t y = piece.top + i / channels / piece.width;
    if (x >= content.width || y >= content.height) continue;  // what a tile has too much
    words[i] = content.samples[(y * content.width + x) * content.channels + plane + i % channels];
  }
  Bytes bytes(words.begin(), words.end());
  void* data = content.bits == 8 ? static_cast<void*>(bytes.data()) : words.data();
  const auto size = static_cast<tmsize_t>(words.size() * content.bits / 8);
  if (content.tile > 0) {
    const uint32_t tile = TIFFComputeTile(tiff, piece.left, piece.top, 0, plane);
    TIFFWriteEncodedTile(tiff, tile, data, size);
  } else {
    TIFFWriteEncodedStrip(tiff, TIFFComputeStrip(tiff, piece.top, plane), data, size);
  }
}

void write_picture(TIFF* tiff, const TiffContent& content) {
  Piece piece{0, 0, content.tile > 0 ? content.tile : content.width,
              content.tile > 0 ? content.tile : 2};
  const uint32_t step = piece.height;
  set_fields(tiff, content, piece);
  const uint16_t planes = content.planes == 2 ? content.channels : uint16_t{1};
  for (uint16_t plane = 0; plane < planes; ++plane) {
    for (piece.top = 0; piece.top < content.height; piece.top += step) {
      piece.height = content.tile > 0 ? step : std::min(step, content.height - piece.top);
      for (piece.left = 0; piece.left < content.width; piece.left += piece.width) {
        write_piece(tiff, content, piece, plane);
      }
    }
  }
  TIFFWriteDirectory(tiff);
}

}  // namespace

Bytes make_tiff(const TiffContent& content) {
  const TempFolder folder;
  const std::string path = (folder / "a.tif").string();
  TIFF* tiff = TIFFOpen(path.c_str(), content.order);
  for (unsigned i = 0; i < content.pictures; ++i) write_picture(tiff, content);
  TIFFClose(tiff);
  return get_file(path);
}

}  // namespace hmlfc::test
