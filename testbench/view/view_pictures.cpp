#include "view/view_pictures.hpp"

#include <optional>

#include "arithmetic/rounding.hpp"
#include "bits/little_endian.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {
namespace {

Descriptor whole(const ViewHost& host, ViewPos view, ViewFormat format) {
  const hmlfc_plane& plane =
      host.stream().planes[format <= ViewFormat::kCg ? static_cast<size_t>(format) : 0];
  return {.row = view.row,
          .col = view.col,
          .format = format,
          .width = plane.width,
          .height = plane.height};
}

hmlfc_status run(ViewHost& host, Descriptor& descriptor) {
  host.free_all();
  host.allocate(descriptor, 0, true);
  return host.run(descriptor);
}

bool is_bad(const ViewHost& host, const Descriptor& d, uint32_t bx, uint32_t by) {
  const uint32_t b = host.parameters().block_size();
  const uint32_t tiles_x = ceil_div(d.width, kTileBlocks * b);
  const uint64_t tile = uint64_t{by / kTileBlocks} * tiles_x + bx / kTileBlocks;
  const auto word = load_le<uint64_t>(host.memory().content.at(d.bitmap), 8 * tile);
  return (word >> (8 * (by % kTileBlocks) + bx % kTileBlocks) & 1) != 0;
}

// The first block with an error, row by row.
std::optional<Descriptor> first_bad_block(const ViewHost& host, const Descriptor& d) {
  const uint32_t b = host.parameters().block_size();
  for (uint32_t by = 0; by < ceil_div(d.height, b); ++by) {
    for (uint32_t bx = 0; bx < ceil_div(d.width, b); ++bx) {
      if (!is_bad(host, d, bx, by)) continue;
      Descriptor block = d;
      block.x = bx * b;
      block.y = by * b;
      block.width = block.height = 1;
      return block;
    }
  }
  return std::nullopt;
}

// RGB decodes all planes block by block; the error of a view is that of the planes in turn (DEC-7).
unsigned error_of_view(ViewHost& host, ViewPos view, unsigned error) {
  for (const ViewFormat plane : {ViewFormat::kY, ViewFormat::kCo, ViewFormat::kCg}) {
    Descriptor d = whole(host, view, plane);
    if (run(host, d).blocks == 0) continue;
    auto block = first_bad_block(host, d);
    return block ? run(host, *block).first_error : error;
  }
  return error;
}

}  // namespace

RgbImage read_pixels(const Descriptor& d, const SparseBytes& memory, int depth) {
  const std::span<const uint8_t> pixels = memory.at(d.destination);
  RgbImage image{d.width, d.height, depth, {}};
  const unsigned bytes = bytes_of(d.format);
  const unsigned bits = bits_of(d.format);
  for (uint32_t y = 0; y < d.height; ++y) {
    for (uint32_t x = 0; x < d.width; ++x) {
      uint64_t pixel = 0;
      const uint64_t at = uint64_t{y} * d.pitch + uint64_t{x} * bytes;
      for (unsigned k = 0; k < bytes; ++k) pixel |= uint64_t{pixels[at + k]} << 8 * k;
      for (unsigned c = 0; c < 3; ++c) {
        image.samples.push_back(static_cast<uint16_t>(pixel >> c * bits & ((1u << bits) - 1)));
      }
    }
  }
  return image;
}

tl::expected<RgbImage, unsigned> decode_view(ViewHost& host, ViewPos view) {
  Descriptor d = whole(host, view, ViewFormat::kRgb161616);
  const hmlfc_status status = run(host, d);
  if (status.result == HMLFC_DONE)
    return read_pixels(d, host.memory().content, host.stream().depth);
  if (status.result != HMLFC_BLOCK_ERRORS) return tl::unexpected<unsigned>(kBusError);
  return tl::unexpected(error_of_view(host, view, status.first_error));
}

}  // namespace hmlfc::tb
