#include "render/golden_blocks.hpp"

#include <tuple>

#include "render/shown_image.hpp"

namespace hmlfc {
namespace {

// By how many bits a coordinate of a pixel shrinks to one of a sample of `plane` (COL-3).
unsigned halving(const StreamHeader& header, Plane plane) {
  return plane != Plane::kY && header.chroma_format == ChromaFormat::k420 ? 1 : 0;
}

}  // namespace

bool BlockOrder::operator()(const BlockAddress& a, const BlockAddress& b) const {
  return std::tie(a.view.row, a.view.col, a.plane, a.by, a.bx) <
         std::tie(b.view.row, b.view.col, b.plane, b.by, b.bx);
}

// The block that holds the sample of pixel (x, y) of the image that `view` shows (COL-3, STR-6).
BlockAddress GoldenBlocks::block_of(ViewPos view, Plane plane, int32_t x, int32_t y) const {
  const StreamHeader& header = decoder_.header();
  const unsigned shift = header.block_log2 + halving(header, plane);
  return {first_view_of(header, view, stop_level_), plane, static_cast<uint32_t>(x) >> shift,
          static_cast<uint32_t>(y) >> shift};
}

uint64_t GoldenBlocks::need(const ViewTaps& taps) {
  uint64_t pixels = 0;
  for (int32_t y = taps.y.first; y <= taps.y.last(); ++y) {
    for (int32_t x = taps.x.first; x <= taps.x.last(); ++x) {
      ++pixels;
      for (const Plane plane : kPlanes) blocks_.try_emplace(block_of(taps.view, plane, x, y));
    }
  }
  return pixels;
}

std::vector<BlockAddress> GoldenBlocks::list() const {
  std::vector<BlockAddress> list;
  for (const auto& [block, samples] : blocks_) list.push_back(block);
  return list;
}

Result<void> GoldenBlocks::decode() {
  for (auto& [block, samples] : blocks_) {
    auto decoded = decoder_.decode_block(block, {.stop_level = stop_level_});
    if (!decoded) return tl::unexpected(decoded.error());
    samples = std::move(*decoded);
  }
  return {};
}

int32_t GoldenBlocks::sample(ViewPos view, Plane plane, int32_t x, int32_t y) const {
  const StreamHeader& header = decoder_.header();
  const unsigned shift = halving(header, plane);
  const uint32_t side = header.block_size();
  const uint32_t column = (static_cast<uint32_t>(x) >> shift) % side;
  const uint32_t row = (static_cast<uint32_t>(y) >> shift) % side;
  return blocks_.at(block_of(view, plane, x, y))[row * side + column];
}

Rgb GoldenBlocks::pixel(ViewPos view, int32_t x, int32_t y) const {
  return inverse_colour({sample(view, Plane::kY, x, y), sample(view, Plane::kCo, x, y),
                         sample(view, Plane::kCg, x, y)},
                        decoder_.header().depth);
}

Rgb GoldenBlocks::colour(const ViewTaps& taps) const {
  const auto at = [&](int32_t x, int32_t y) { return pixel(taps.view, x, y); };
  const Rgb p00 = at(taps.x.first, taps.y.first);
  const Rgb p10 = at(taps.x.last(), taps.y.first);
  const Rgb p01 = at(taps.x.first, taps.y.last());
  const Rgb p11 = at(taps.x.last(), taps.y.last());
  const int depth = decoder_.header().depth;
  return {interpolate_pixels(taps.x, taps.y, p00.r, p10.r, p01.r, p11.r, depth),
          interpolate_pixels(taps.x, taps.y, p00.g, p10.g, p01.g, p11.g, depth),
          interpolate_pixels(taps.x, taps.y, p00.b, p10.b, p01.b, p11.b, depth)};
}

}  // namespace hmlfc
