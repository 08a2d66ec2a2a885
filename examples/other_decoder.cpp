// The stand-in for a decoder of your own: this library behind an interface of another style.
#include "other_decoder.h"

#include <algorithm>
#include <new>
#include <utility>

#include <hmlfc/decoder.hpp>

struct other_decoder {
  hmlfc::Decoder decoder;

  hmlfc::ViewPos view(uint32_t number) const {
    const uint32_t cols = decoder.header().cols;
    return {number / cols, number % cols};
  }
};

other_decoder* other_open(const uint8_t* bytes, size_t size, int* error) {
  auto decoder = hmlfc::Decoder::open({bytes, size});
  *error = static_cast<int>(decoder ? hmlfc::ErrorCode::kOutOfMemory : decoder.error().code);
  return decoder ? new (std::nothrow) other_decoder{std::move(*decoder)} : nullptr;
}

other_info other_get_info(const other_decoder* decoder) {
  const hmlfc::StreamHeader& header = decoder->decoder.header();
  return {header.rows,
          header.cols,
          header.width,
          header.height,
          static_cast<uint32_t>(header.depth),
          header.chroma_format == hmlfc::ChromaFormat::k444 ? 1u : 0u,
          header.block_size(),
          static_cast<uint32_t>(header.tree_height) + 1};
}

int other_decode_planes(other_decoder* decoder, uint32_t view, uint16_t* planes) {
  const auto image = decoder->decoder.decode_view(decoder->view(view));
  if (!image) return static_cast<int>(image.error().code);
  const size_t pixels = image->samples.size() / 3;
  for (size_t i = 0; i < image->samples.size(); ++i) {
    planes[i % 3 * pixels + i / 3] = image->samples[i];
  }
  return 0;
}

int other_decode_block(other_decoder* decoder, uint32_t view, char plane, uint32_t block_x,
                       uint32_t block_y, uint32_t level, int32_t* samples) {
  const hmlfc::Plane coded = plane == 'Y'   ? hmlfc::Plane::kY
                             : plane == 'o' ? hmlfc::Plane::kCo
                                            : hmlfc::Plane::kCg;
  const int stop_level = decoder->decoder.header().tree_height - static_cast<int>(level);
  const auto block = decoder->decoder.decode_block({decoder->view(view), coded, block_x, block_y},
                                                   {.stop_level = stop_level});
  if (!block) return static_cast<int>(block.error().code);
  std::ranges::copy(*block, samples);
  return 0;
}

void other_close(other_decoder* decoder) { delete decoder; }
