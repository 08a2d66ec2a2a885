// Blocks that a frame needs, as bits: image by image of the level shown, row by row, in each the
// blocks of planes Y, Co and Cg, row by row (the order of NED-2).

uint blocks_of_plane(uint p) {
  return arguments.shape.planes[p].blocks_x * arguments.shape.planes[p].blocks_y;
}

/// The first bit of image (row, column): the sum of those of (row, 0) and (0, column).
uint first_bit(uvec2 image) {
  const uint number = image.x * arguments.shape.levels[frame().stop_level].cols + image.y;
  return number * (blocks_of_plane(0u) + 2u * blocks_of_plane(1u));
}

/// Where the bits of an image's blocks lie.
struct BlockBits {
  uint luma_columns, chroma_columns;  // blocks a row
  uint luma, chroma;                  // blocks of plane Y, of Co and of Cg
};

BlockBits block_bits() {
  return BlockBits(arguments.shape.planes[0].blocks_x, arguments.shape.planes[1].blocks_x,
                   blocks_of_plane(0u), blocks_of_plane(1u));
}

/// The bit of block (bx, by) of plane Y, or of plane Co, of the image whose first bit is `first`. The
/// Cg bit is at the Co bit + bits.chroma.
uint luma_bit(BlockBits bits, uint first, uvec2 block) {
  return first + block.y * bits.luma_columns + block.x;
}
uint chroma_bit(BlockBits bits, uint first, uvec2 block) {
  return first + bits.luma + block.y * bits.chroma_columns + block.x;
}

/// The request of a bit: the inverse of luma_bit and chroma_bit.
Request request_of_bit(uint bit) {
  const uint luma = blocks_of_plane(0u);
  const uint chroma = blocks_of_plane(1u);
  const uint number = bit / (luma + 2u * chroma);
  uint at = bit - number * (luma + 2u * chroma);
  uint p = 0u;
  if (at >= luma) {
    p = at < luma + chroma ? 1u : 2u;
    at -= luma + (p - 1u) * chroma;
  }
  const uint cols = arguments.shape.levels[frame().stop_level].cols;
  const uint blocks_x = arguments.shape.planes[p].blocks_x;
  const uint image_row = number / cols;
  const uint by = at / blocks_x;
  return Request(image_row | (number - image_row * cols) << 16, (at - by * blocks_x) | by << 16,
                 p | frame().stop_level << 8 | 1u << 16);
}

/// Where the slots of held blocks are found.
#ifdef HMLFC_BOUND
struct HeldBlocks {
  uint last_page;
};

#define held_blocks() HeldBlocks(frame().pool_pages - 1u)
#define pages_of(held) frame().pages
#else
struct HeldBlocks {
  OutWords pages;
  uint last_page;
};

HeldBlocks held_blocks() { return HeldBlocks(frame().pages, frame().pool_pages - 1u); }
#define pages_of(held) held.pages
#endif

/// The slot of the block of a bit, if it is held; else any slot that there is.
uint slot_of_bit(HeldBlocks held, uint bit) {
  return min(pages_of(held).word[bit >> 5], held.last_page) << 5 | (bit & 31u);
}

/// Where sample (x, y) of a plane lies in its image.
struct SamplePlace {
  uvec2 block;
  uint at;  // position in the block
};

SamplePlace place_of_sample(uvec2 sample_at, uint log2) {
  const uvec2 block = sample_at >> log2;
  const uvec2 in_block = sample_at - (block << log2);
  return SamplePlace(block, (in_block.y << log2) + in_block.x);
}
