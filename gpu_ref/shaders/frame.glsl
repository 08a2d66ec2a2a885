// A frame to be rendered (docs/rendering.md, REC-2) and the buffers of its blocks.
// FrameArguments of gpu_ref/device/arguments.hpp has the same members in the same order.

struct FrameRecord {
  int frame_width, frame_height;
  int filter_kind;
  int aperture;
  int n0_hi[3], n0_lo[3];
  int na_hi[3], na_lo[3];
  int nb_hi[3], nb_lo[3];
  int u0, v0, zu, zv;
  int x0, y0, gain, dx, dy;
  int c0, r0, cols, rows;
  int width, height;
  int geometry, focus, pitch, fine;
};

layout(buffer_reference, std430, buffer_reference_align = 16) buffer Rays { ivec4 ray[]; };

layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Frame {
  OutWords needed;     // one bit a block (block_bits.glsl); 0 between frames
  OutWords held;       // as many: the blocks whose samples are in the pool
  OutWords pages;      // by word of bits: the page of the pool for its 32 blocks; if one is held
  OutWords slots;      // by request: the slot of the pool for its samples, and its bit
  OutWords counters;   // kCount..., of this frame
  OutWords used_pages; // pages that the frames before use, or kUsedNothingHeld; the level of their blocks
  OutWords results;    // for the host: the counters
  OutWords dispatches; // kDispatch..., three words each
  OutWords drawn;      // three samples of 16 bits a pixel, rows of an even number of pixels
  Rays rays;           // of each pixel, group by group (pixel_group.glsl)
  OutWords displacements; // E of each cell (SRF-1), row by row; with geometry
  Words disparities;   // of the blocks of plane Y of all views, view by view: D, and 2^16 if there is one
  OutWords looked_up;  // bits as in needed: the blocks whose disparity the frame looks up (SRF-5)
  uvec2 pool;          // pages of 32 slots, of a block each: OutWords, or OutChunks with kPoolChunked
  uint pool_chunk_log2;
  uint pool_pages;     // that there is room for
  uint kept_pages;     // that frames may leave to the next one
  uint stop_level;
  uint capacity;       // requests that there is room for
  uint needed_words;
  uint forget;         // 1: what frames before hold is not used
  FrameRecord record;
};
