// What the header says and what follows from it: written by gpu_ref/decode/stream_shape.cpp, whose
// structs have the same members in the same order.

struct LevelShape {
  uint rows, cols;              // images of the level; views at level 0 (STR-1, STR-3)
  uint ref_rows, ref_cols;      // images of a reference group (STR-4)
  uint group_rows, group_cols;  // reference groups of the level
  uint first_image;             // F_l of IDX-1
  uint first_reference;         // number of its first reference image in the reference area
  uint keyed;                   // 1: its reference images are key images (EXT-4)
  uint row_inverse, col_inverse;              // what divided() takes for the divisors of group_in_line
  uint group_row_inverse, group_col_inverse;  // and for group_rows and group_cols
  uint pad0, pad1, pad2;
};

struct PlaneShape {
  uint width, height;            // samples (STR-2)
  uint blocks_x, blocks_y;       // STR-6
  uint tiles_x, tiles_y;
  uint first_tile;               // within an image (IDX-2)
  uint motion_plane;             // index of the one that serves this plane (MOT-1)
  uint halved;                   // 1: half the width and height of that motion plane (MOT-4)
  uint row_words, first_word;    // of the plane within a reference image of the reference area
  int lo, hi, bound;             // samples in [lo, hi], residuals in [-bound, bound] (STR-7)
  uint pad0, pad1;
};

struct MotionPlaneShape {
  uint width, height;  // samples (MOT-1)
  uint tiles_x, tiles_y;
  uint first_tile;     // within an image (IDX-2)
  uint pad0, pad1, pad2;
};

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer StreamShape {
  uint features;         // feature_flags (EXT-1)
  uint block_log2;
  uint window;
  uint depth;
  uint cluster_rows, cluster_cols;
  uint top;              // tree_height
  uint tiles_per_image;  // sum of all T_p (IDX-2, MOT-1)
  uint vector_precision, disparity_precision;  // EXT-2
  uint motion_tile_log2, disparity_grid_log2;
  int row_scale;
  uint component_bits, max_code, code_bits;    // v, K, c of TIL-6
  uint group_word, group_records;              // section GROUP: first stream word, number of records
  uint tile_word;                              // section TILE: its first stream word
  uint tile_bytes_low, tile_bytes_high;
  uint stream_chunk_log2;                      // words of a chunk of the stream
  uint reference_chunk_log2;                   // and of the reference area
  uint reference_words;                        // words of one reference image in the area
  uint chroma_halved;                          // 1 in format 4:2:0 (STR-2)
  uint cluster_row_inverse, cluster_col_inverse;  // what divided() takes for cluster_rows, cluster_cols
  uint pad0;
  LevelShape levels[16];
  PlaneShape planes[3];
  MotionPlaneShape motion_planes[2];
};
