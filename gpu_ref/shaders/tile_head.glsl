// The fields of a residual tile's record before its block headers (TIL-1 to TIL-8, STP-1).

const uint kSignsMinus = 1u;
const uint kSignsMixed = 2u;

/// A component of the vectors of a tile (TIL-6).
struct VectorAxis {
  int least;     // min_x or min_y
  Levels levels;
  uint values;   // bit of the sequence in the record
};

struct TileHead {
  uint status;
  uvec2 motion_mask;
  uvec2 residual_mask;
  uint sign_mode;
  uint signs;  // bit of the first in the record
  VectorAxis x, y;
  uint level_base, level_bits, bias_bits;
  uint step_base, step_bits;
  uint headers;  // bit of the first block header
  uint values;   // bit of the first block value
};

/// Number of block (i, j) of a tile (TIL-2).
uint block_number(uint i, uint j) {
  return 4u * (4u * (j >> 1) + (i >> 1)) + 2u * (j & 1u) + (i & 1u);
}

/// The blocks of tile (tx, ty) that lie at least partly in the plane (TIL-3): quad by quad of two
/// columns and two rows.
uvec2 blocks_inside(PlaneShape plane, uint tx, uint ty) {
  const uint columns = min(8u, plane.blocks_x - 8u * tx);
  const uint rows = min(8u, plane.blocks_y - 8u * ty);
  if (min(columns, rows) == 8u) return uvec2(~0u);
  uint in_columns = 0u;  // of the 16 blocks of a row of quads
  uvec2 mask = uvec2(0u);
  for (uint q = 0u; q < 4u; ++q) {
    if (2u * q < columns) in_columns |= 0x5u << (4u * q);
    if (2u * q + 1u < columns) in_columns |= 0xAu << (4u * q);
  }
  for (uint q = 0u; q < 4u; ++q) {
    const uint in_rows = (2u * q < rows ? 0x3333u : 0u) | (2u * q + 1u < rows ? 0xCCCCu : 0u);
    const uint quads = (in_columns & in_rows) << (16u * (q & 1u));
    if (q < 2u) mask.x |= quads; else mask.y |= quads;
  }
  return mask;
}

/// A mask of the given mode (TIL-3).
uvec2 read_mask(inout Cursor cursor, uint mode, uvec2 inside) {
  if (mode == 0u) return uvec2(0u);
  if (mode == 1u) return inside;
  if (mode == 2u) {
    const uint low = take(cursor, 32u);
    return uvec2(low, take(cursor, 32u));
  }
  uint quads = take(cursor, 16u);
  const uint count = 4u * uint(bitCount(quads));
  uvec2 blocks = uvec2(take(cursor, min(count, 32u)), 0u);
  if (count > 32u) blocks.y = take(cursor, count - 32u);
  uvec2 mask = uvec2(0u);
  for (; quads != 0u; quads &= quads - 1u) {
    const uint q = uint(findLSB(quads));
    const uint own = (blocks.x & 15u) << (4u * (q & 7u));
    if (q < 8u) mask.x |= own; else mask.y |= own;
    blocks = u64_shift_right(blocks, 4u);
  }
  return mask;
}

// A field after the end of the record reads as 0, which no check below refuses: so each check looks at
// the values alone, and the end, which comes first for every field (TIL-1), is checked once, last.

/// min_x and codes_x, or min_y and codes_y; an error of annex A, or ok (TIL-6).
uint read_axis(inout Cursor cursor, out VectorAxis axis) {
  const uint window = arguments.shape.window;
  axis = VectorAxis(0, levels_of_code(0u), 0u);
  const uint field = take(cursor, arguments.shape.component_bits);
  if (field > 2u * window) return ERROR_VECTOR_RANGE;
  axis.least = int(field) - int(window);
  const uint code = take(cursor, arguments.shape.code_bits);
  if (code > arguments.shape.max_code) return ERROR_BAD_LEVELS;
  axis.levels = levels_of_code(code);
  return ERROR_OK;
}

/// sign_mode to vectors_y; an error of annex A, or ok (TIL-6).
uint read_vectors_head(inout Cursor cursor, inout TileHead head) {
  const uint count = popcount(head.motion_mask);
  head.sign_mode = take(cursor, 2u);
  if (head.sign_mode > kSignsMixed) return ERROR_BAD_MODE;
  uint status = read_axis(cursor, head.x);
  if (status != ERROR_OK) return status;
  status = read_axis(cursor, head.y);
  if (status != ERROR_OK) return status;
  head.signs = cursor.position;
  skip(cursor, head.sign_mode == kSignsMixed ? count : 0u);
  head.x.values = cursor.position;
  skip(cursor, bise_bits(head.x.levels, count));
  head.y.values = cursor.position;
  skip(cursor, bise_bits(head.y.levels, count));
  return cursor.overrun ? ERROR_TILE_OVERRUN : ERROR_OK;
}

/// Bits of a block header (TIL-8, STP-1).
uint header_bits(TileHead head) { return head.level_bits + head.step_bits + head.bias_bits; }

/// level_base to the block headers; an error of annex A, or ok (TIL-8, STP-1).
uint read_residuals_head(inout Cursor cursor, inout TileHead head) {
  head.level_base = take(cursor, 6u);
  head.level_bits = take(cursor, 3u);
  if (head.level_bits > 6u) return ERROR_BAD_MODE;
  head.bias_bits = take(cursor, 4u);
  if (head.bias_bits > arguments.shape.depth + 2u) return ERROR_BAD_MODE;
  if (has_feature(FEATURE_RESIDUAL_STEP)) {
    head.step_base = take(cursor, 4u);
    head.step_bits = take(cursor, 2u);
  }
  head.headers = cursor.position;
  skip(cursor, popcount(head.residual_mask) * header_bits(head));
  head.values = cursor.position;
  return cursor.overrun ? ERROR_TILE_OVERRUN : ERROR_OK;
}

/// Reads the head of a record. `inside`: blocks_inside of its tile. `vectors`: the record has the
/// fields of a predictive image (TIL-1, MOT-2).
TileHead read_tile_head(Record record, uvec2 inside, bool vectors) {
  Cursor cursor = cursor_of(record);
  TileHead head;
  head.step_base = 0u;
  head.step_bits = 0u;
  const uint motion_mode = vectors ? take(cursor, 2u) : 0u;
  const uint residual_mode = take(cursor, 2u);
  head.motion_mask = read_mask(cursor, motion_mode, inside);
  head.residual_mask = read_mask(cursor, residual_mode, inside);
  head.status = cursor.overrun ? ERROR_TILE_OVERRUN : ERROR_OK;
  if (head.status == ERROR_OK &&
      ((head.motion_mask | head.residual_mask) & ~inside) != uvec2(0u)) {
    head.status = ERROR_MASK_OUTSIDE;  // TIL-4
  }
  if (head.status == ERROR_OK && head.motion_mask != uvec2(0u)) {
    head.status = read_vectors_head(cursor, head);
  }
  if (head.status == ERROR_OK && head.residual_mask != uvec2(0u)) {
    head.status = read_residuals_head(cursor, head);
  }
  return head;
}
