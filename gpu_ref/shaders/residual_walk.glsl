// The entry of one block in the record of its residual tile (TIL-5 to TIL-9, STP-1).

/// Component m of a tile's vectors (TIL-7).
int vector_component(Record record, VectorAxis axis, uint count, uint m) {
  return axis.least + int(record_value(record, axis.values, axis.levels, count, m));
}

/// The vector of block k, which has one; an error of annex A, or ok (TIL-6, TIL-7).
uint read_vector(Record record, TileHead head, uint k, inout BlockEntry entry) {
  const uint m = rank(head.motion_mask, k);
  const uint count = popcount(head.motion_mask);
  entry.count = 1u;
  entry.negative = head.sign_mode == kSignsMixed ? record_bits(record, head.signs + m, 1u) != 0u
                                                 : head.sign_mode == kSignsMinus;
  const ivec2 vector = ivec2(vector_component(record, head.x, count, m),
                             vector_component(record, head.y, count, m));
  entry.references[0].vector = vector_word(vector, ivec2(0));
  const int window = int(arguments.shape.window);
  return max(abs(vector.x), abs(vector.y)) <= window ? ERROR_OK : ERROR_VECTOR_RANGE;
}

/// The header and the place of the values of block k, which has a residual; an error of annex A, or
/// ok. Adds up the values of the blocks before it (TIL-8, TIL-9).
uint read_residual_header(Record record, TileHead head, uint k, inout BlockEntry entry) {
  const uint samples = 1u << (2u * arguments.shape.block_log2);
  const uint most = MAX_LEVEL_CODE_OF_DEPTH_8 + 3u * (arguments.shape.depth - 8u);
  const uint m = rank(head.residual_mask, k);
  const uint trit_bits = ceil_div(TRIT_GROUP_BITS * samples, TRITS_IN_GROUP);
  const uint quint_bits = ceil_div(QUINT_GROUP_BITS * samples, QUINTS_IN_GROUP);
  uint header = head.headers;
  uint values = head.values;
  uint bits = 0u;
  for (uint i = 0u; i <= m; ++i) {
    values += bits;
    const uint fields = record_bits(record, header, head.level_bits + head.step_bits);
    entry.level_code = head.level_base + low_bits(fields, head.level_bits);
    entry.step_code = head.step_base + (fields >> head.level_bits);
    if (entry.level_code > most || entry.step_code > MAX_STEP_CODE) return ERROR_BAD_LEVELS;
    const Levels levels = levels_of_code(entry.level_code);
    bits = levels.plain_bits * samples;  // bise_bits
    if (levels.digit != DIGIT_NONE) bits += levels.digit == DIGIT_TRIT ? trit_bits : quint_bits;
    header += header_bits(head);
  }
  entry.bias = sign_extend(record_bits(record, header - head.bias_bits, head.bias_bits),
                           head.bias_bits);
  if (!holds(record, values, bits)) return ERROR_TILE_OVERRUN;
  entry.residual = true;
  const uint at = record.bit + values;
  entry.values_word = record.word + (at >> 5);
  entry.values_bit = at & 31u;
  return ERROR_OK;
}

/// The number of a tile of image `image` (IDX-2); `tile` is its number within the image.
uvec2 tile_number(uint image, uint tile) {
  return u64_add(u64_product(image, arguments.shape.tiles_per_image), uvec2(tile, 0u));
}

/// Reads block (bx, by) of a plane of the image with number `image` (IDX-1) into `entry`: its
/// values' place and, with `vectors`, its vector (TIL-1, MOT-2). An error of annex A, or ok.
uint walk_to_residual(uint image, PlaneShape plane, uint bx, uint by, bool vectors,
                      inout BlockEntry entry) {
  const uint tx = bx >> 3;
  const uint ty = by >> 3;
  const Record record = find_tile(tile_number(image, plane.first_tile + ty * plane.tiles_x + tx));
  if (record.empty) return record.status;
  const TileHead head = read_tile_head(record, blocks_inside(plane, tx, ty), vectors);
  if (head.status != ERROR_OK) return head.status;
  const uint k = block_number(bx & 7u, by & 7u);
  if (has_bit(head.motion_mask, k)) {
    const uint status = read_vector(record, head, k, entry);
    if (status != ERROR_OK) return status;
  }
  return has_bit(head.residual_mask, k) ? read_residual_header(record, head, k, entry) : ERROR_OK;
}
