// The arguments of every kernel, and the buffers that they point to. Device addresses are words of 64 bits
// that no shader computes with. gpu_ref/device/arguments.hpp has the same members in the same order.

#include "stream_shape.glsl"

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Words { uint word[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer OutWords { uint word[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Chunks { Words chunk[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer OutChunks {
  OutWords chunk[];
};

/// A rectangle of blocks of one plane of one image; requests are numbered area by area, row by row.
struct Area {
  uint first_request;
  uint row, col;    // of a view; with `exact`, of an image of level `level`
  uint plane;
  uint level;       // stop level s of DEC-1
  uint bx, by;      // its first block
  uint columns;     // blocks a row
  uint exact;
  uint pad0, pad1, pad2;
};

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer Areas { Area area[]; };

/// One block of one image to be decoded, made by expand.comp.
struct Request {
  uint image;  // row + 2^16 * column in the level's grid of images
  uint block;  // bx + 2^16 * by
  uint site;   // plane + 2^8 * level + 2^16 * valid
};

/// A rectangle of pixels in RGB: blocks of plane Y and the chroma blocks they need (COL-3), numbered
/// by their requests.
struct ColourArea {
  uint first_block;        // number of its first block among all blocks in RGB
  uint columns;            // blocks a row
  uint bx, by;             // its first block
  uint luma;               // request of its first block of plane Y
  uint co, cg;             // requests of its first blocks of planes Co and Cg
  uint chroma_bx, chroma_by;
  uint chroma_columns;
  uint first_texel;        // with kTexels: number of its first texel among all
  uint pad0;
};

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ColourAreas {
  ColourArea area[];
};

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Requests { Request request[]; };

/// Entries of blocks, as block_entry.glsl packs them: two halves each.
layout(buffer_reference, std430, buffer_reference_align = 16) buffer Entries { uvec4 half_entry[]; };

layout(push_constant, std430) uniform Arguments {
  StreamShape shape;
  uvec2 stream;          // ROOT, GROUP and TILE: Words, or Chunks with kChunked
  uvec2 references;      // the reference area: OutWords, or OutChunks with kChunked
  Areas areas;
  Requests requests;
  Entries entries;       // tree_height + 1 of ENTRY_WORDS words a request
  OutWords statuses;     // one a request
  OutWords samples;      // two samples a word, B * B / 2 words a request
  OutWords stages;       // of the debug variant: four stages a level a request
  OutWords damage;       // word 0: not 0 where blocks of the reference area did not decode
  ColourAreas colour_areas;
  OutWords pixels;       // three lanes of B * B / 2 words a block in RGB; with kTexels: texels.glsl
  OutWords pixel_statuses;
  uint area_count;
  uint request_count;
  uint colour_area_count;
  uint pixel_count;      // blocks in RGB
  uvec2 frame;           // of the rendering kernels (frame.glsl)
} arguments;

/// The stream or the reference area is in more than one buffer.
layout(constant_id = 0) const bool kChunked = false;

layout(local_size_x = 64) in;

/// The number of this invocation among all.
uint invocation() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
         gl_LocalInvocationIndex;
}

bool has_feature(uint feature) { return (arguments.shape.features & (1u << feature)) != 0u; }
