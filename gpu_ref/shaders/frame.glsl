// A frame to be rendered (docs/rendering.md, REC-2) and the buffers of its blocks.
// FrameShape of gpu_ref/block_pool.hpp has the same members in the same order.

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
  int geometry, focus, pitch;
};

layout(buffer_reference, std430, buffer_reference_align = 16) buffer Rays { ivec4 ray[]; };

layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Frame {
  OutWords needed;     // one bit a block (block_bits.glsl); 0 between frames
  OutWords held;       // as many: the blocks whose samples are in the pool
  OutWords pages;      // by word of bits: the page of the pool for its 32 blocks; if one is held
  OutWords slots;      // by request: the slot of the pool for its samples, and its bit
  OutWords counters;   // kCount..., of this frame
  OutWords used_pages; // pages that the frames before use, or kUsedNothingHeld
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

// Words of the counters.
const uint kCountNeeded = 0u;        // blocks that the frame needs
const uint kCountNeededPages = 1u;   // words of bits with such a block
const uint kCountMissing = 2u;       // needed blocks that are not held
const uint kCountMissingPages = 3u;  // words with such a block of which no block is held
const uint kCountMode = 4u;          // kMode...
const uint kCountDecoded = 5u;       // blocks that the frame decodes, or would with room
const uint kCountPages = 6u;         // pages in use after it, likewise
const uint kCountRequests = 7u;      // requests written so far
const uint kCountNextPage = 8u;      // the next page to be given away
const uint kCountFirstError = 9u;    // the least bit of a block with an error, or all ones
const uint kCountStatus = 10u;       // that block's error
const uint kCountWorkgroups = 11u;   // of mark.comp that are done
const uint kCountLookedUp = 12u;     // blocks whose disparity the frame looks up
const uint kFrameCounters = 13u;

/// In the place of the number of used pages: the next frame decodes all that it needs.
const uint kUsedNothingHeld = 0xFFFFFFFFu;

// The sizes of the dispatches that frame_plan.glsl decides.
const uint kDispatchWalk = 0u;
const uint kDispatchSamples = 3u;

// What a frame does (frame_plan.glsl).
const uint kModeNoRoom = 0u;  // nothing: the host makes room
const uint kModeAdd = 1u;     // decodes the needed blocks that are not held
const uint kModeFlush = 2u;   // forgets what is held and decodes all needed blocks
