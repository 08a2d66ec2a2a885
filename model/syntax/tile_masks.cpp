#include "syntax/tile_masks.hpp"

#include <bit>

#include "bits/bit_string.hpp"

namespace hmlfc {
namespace {

uint32_t quad_blocks(uint64_t mask, unsigned q) {
  return static_cast<uint32_t>((mask >> (kBlocksInQuad * q)) & 0xF);
}

uint32_t quad_mask(uint64_t mask) {
  uint32_t quads = 0;
  for (unsigned q = 0; q < kQuadsInTile; ++q) {
    quads |= static_cast<uint32_t>(quad_blocks(mask, q) != 0) << q;
  }
  return quads;
}

uint64_t read_quad_mask(FieldCursor& cursor) {
  const uint32_t quads = cursor.take("quad_mask", "TIL-3", kQuadsInTile);
  uint64_t mask = 0;
  for (unsigned q = 0; q < kQuadsInTile; ++q) {
    if (!has_bit(quads, q)) continue;
    const uint64_t blocks = cursor.take("quad_blocks", "TIL-3", kBlocksInQuad);
    mask |= blocks << (kBlocksInQuad * q);
  }
  return mask;
}

}  // namespace

uint32_t mask_mode(uint64_t mask, uint64_t inside) {
  if (mask == 0) return kMaskNone;
  if (mask == inside) return kMaskAll;
  const auto quads = static_cast<unsigned>(std::popcount(quad_mask(mask)));
  return kQuadsInTile + kBlocksInQuad * quads < 64 ? kMaskQuads : kMaskRaw;
}

unsigned mask_bits(uint64_t mask, uint32_t mode) {
  if (mode == kMaskRaw) return 64;
  if (mode != kMaskQuads) return 0;
  return kQuadsInTile + kBlocksInQuad * static_cast<unsigned>(std::popcount(quad_mask(mask)));
}

uint64_t read_mask(FieldCursor& cursor, uint32_t mode, uint64_t inside) {
  switch (mode) {
    case kMaskAll:
      return inside;
    case kMaskRaw:
      return cursor.take64("mask", "TIL-3");
    case kMaskQuads:
      return read_quad_mask(cursor);
    default:
      return 0;
  }
}

void put_mask(BitWriter& writer, uint64_t mask, uint32_t mode) {
  if (mode == kMaskRaw) {
    writer.put(static_cast<uint32_t>(mask), 32);
    writer.put(static_cast<uint32_t>(mask >> 32), 32);
  } else if (mode == kMaskQuads) {
    const uint32_t quads = quad_mask(mask);
    writer.put(quads, kQuadsInTile);
    for (unsigned q = 0; q < kQuadsInTile; ++q) {
      if (has_bit(quads, q)) writer.put(quad_blocks(mask, q), kBlocksInQuad);
    }
  }
}

}  // namespace hmlfc
