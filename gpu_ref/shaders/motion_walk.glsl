// The motion of a block in motion tiles: palette entry, disparity, vectors (MOT-3 to MOT-8).

const uint kChoiceNone = 0u;
const uint kChoiceOwn = 1u;
const uint kChoiceLastNeighbour = 9u;
const uint kChoiceDisparity = 10u;
const uint kChoiceVector = 11u;

struct PaletteEntry {
  uint reference_set;
  uint choice;
  bool negative;
  int explicit_x, explicit_y;
};

/// The next palette entry, of at most 32 bits (MOT-3).
PaletteEntry read_palette_entry(inout Cursor cursor, bool keyed, uint explicit_bits) {
  const uint fields = peek(cursor);
  const uint set_bits = has_feature(FEATURE_TWO_REFERENCES) ? 3u : 0u;
  PaletteEntry entry;
  entry.reference_set = low_bits(fields, set_bits);
  entry.choice = (fields >> set_bits) & 15u;
  uint bits = set_bits + 4u;
  entry.negative = !keyed && ((fields >> bits) & 1u) != 0u;
  bits += keyed ? 0u : 1u;
  const uint x_bits = entry.choice == kChoiceDisparity || entry.choice == kChoiceVector
                          ? explicit_bits : 0u;
  const uint y_bits = entry.choice == kChoiceVector ? explicit_bits : 0u;
  entry.explicit_x = sign_extend(fields >> bits, x_bits);
  entry.explicit_y = sign_extend(fields >> (bits + x_bits), y_bits);
  skip(cursor, bits + x_bits + y_bits);
  return entry;
}

/// What every block of an empty motion tile has (MOT-4).
PaletteEntry empty_palette_entry(bool keyed) {
  const uint set = has_feature(FEATURE_TWO_REFERENCES) ? 1u : 0u;
  const bool disparities = has_feature(FEATURE_SHARED_DISPARITY);
  const uint choice = !keyed ? kChoiceNone : disparities ? kChoiceOwn : kChoiceVector;
  return PaletteEntry(set, choice, false, 0, 0);
}

/// Whether MOT-3 allows a block to use the entry.
bool is_usable(PaletteEntry entry) {
  if (entry.choice > kChoiceVector) return false;
  return has_feature(FEATURE_SHARED_DISPARITY) || entry.choice == kChoiceNone ||
         entry.choice == kChoiceVector;
}

/// Size in samples of the motion tile with number (tx, ty).
uvec2 motion_tile_size(MotionPlaneShape plane, uvec2 tile) {
  const uint log2 = arguments.shape.motion_tile_log2;
  return min(uvec2(1u << log2), uvec2(plane.width, plane.height) - (tile << log2));
}

/// The record of motion tile (tx, ty) of the image with number `image` (MOT-4).
Record find_motion_tile(uint image, MotionPlaneShape plane, uvec2 tile) {
  return find_tile(tile_number(image, plane.first_tile + tile.y * plane.tiles_x + tile.x));
}

/// The palette entry of place `place` of a predictive image; an error of annex A, or ok.
uint walk_to_palette(uint image, MotionPlaneShape plane, uvec2 place, bool keyed,
                     out PaletteEntry entry) {
  const uint log2 = arguments.shape.motion_tile_log2;
  const uvec2 tile = place >> log2;
  entry = empty_palette_entry(keyed);
  const Record record = find_motion_tile(image, plane, tile);
  if (record.empty) return record.status;
  Cursor cursor = cursor_of(record);
  const uint block_log2 = 2u + take(cursor, 2u);
  const uint size = take(cursor, 3u);  // entries less 1
  const uint explicit_bits = take(cursor, 4u);
  if (cursor.overrun) return ERROR_TILE_OVERRUN;
  if (explicit_bits > MAX_EXPLICIT_BITS || block_log2 < arguments.shape.block_log2) {
    return ERROR_BAD_MODE;
  }
  Cursor palette = cursor;
  uvec2 places = uvec2(0u);  // of entries, in bits from the first, 8 bits each
  for (uint e = 0u; e <= size; ++e) {
    const uint place = (cursor.position - palette.position) << (8u * (e & 3u));
    if (e < 4u) places.x |= place; else places.y |= place;
    read_palette_entry(cursor, keyed, explicit_bits);
  }
  const uvec2 blocks = (motion_tile_size(plane, tile) + ((1u << block_log2) - 1u)) >> block_log2;
  const uint count = blocks.x * blocks.y;
  const Levels levels = levels_of_code(kPaletteLevelCode[size]);
  const uint indices = cursor.position;
  skip(cursor, bise_bits(levels, count));
  if (cursor.overrun) return ERROR_TILE_OVERRUN;
  const uvec2 block = (place - (tile << log2)) >> block_log2;
  const uint index = record_value(record, indices, levels, count, block.y * blocks.x + block.x);
  if (index > size) return ERROR_BAD_MODE;
  palette.position += ((index < 4u ? places.x : places.y) >> (8u * (index & 3u))) & 0xFFu;
  entry = read_palette_entry(palette, keyed, explicit_bits);
  return is_usable(entry) ? ERROR_OK : ERROR_BAD_MODE;
}

/// The grid block of choice 1 to 9 for place `place` (MOT-6).
uvec2 grid_block(MotionPlaneShape plane, uvec2 place, uint choice) {
  const uint log2 = arguments.shape.disparity_grid_log2;
  // Left, right, above, below, above left, above right, below left, below right (MOT-5).
  const ivec2 kSteps[9] = ivec2[9](ivec2(0, 0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1),
                                   ivec2(0, 1), ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1),
                                   ivec2(1, 1));
  const ivec2 last = ivec2((uvec2(plane.width, plane.height) - 1u) >> log2);
  return uvec2(clamp(ivec2(place >> log2) + kSteps[choice - 1u], ivec2(0), last));
}

/// The disparity of grid block `block` of the reference image with number `image`; an error of
/// annex A, or ok (MOT-6).
uint walk_to_disparity(uint image, MotionPlaneShape plane, uvec2 block, out int disparity) {
  const uint grid_log2 = arguments.shape.disparity_grid_log2;
  const uint tile_log2 = arguments.shape.motion_tile_log2 - grid_log2;  // in grid blocks
  const uvec2 tile = block >> tile_log2;
  disparity = 0;
  const Record record = find_motion_tile(image, plane, tile);
  if (record.empty) return record.status;
  Cursor cursor = cursor_of(record);
  const int least = sign_extend(take(cursor, 13u), 13u);
  const uint code = take(cursor, 5u);
  if (cursor.overrun) return ERROR_TILE_OVERRUN;
  if (code > MAX_DISPARITY_CODE) return ERROR_BAD_LEVELS;
  const Levels levels = levels_of_code(code);
  const uvec2 blocks = (motion_tile_size(plane, tile) + ((1u << grid_log2) - 1u)) >> grid_log2;
  const uint count = blocks.x * blocks.y;
  const uint values = cursor.position;
  skip(cursor, bise_bits(levels, count));
  if (cursor.overrun) return ERROR_TILE_OVERRUN;
  const uvec2 own = block - (tile << tile_log2);
  disparity = least + int(record_value(record, values, levels, count, own.y * blocks.x + own.x));
  return disparity > MAX_DISPARITY ? ERROR_VECTOR_RANGE : ERROR_OK;
}

/// MOT-8: the vector from image `at` to reference image `reference`.
ivec2 motion_vector(PaletteEntry entry, int disparity, uvec2 at, uvec2 reference) {
  const uint unit_log2 = arguments.shape.vector_precision;
  const int bound = int(arguments.shape.window << unit_log2);
  ivec2 vector = ivec2(entry.explicit_x, entry.explicit_y);
  if (entry.choice != kChoiceVector) {
    const uint s = arguments.shape.disparity_precision - unit_log2;
    const ivec2 offset = ivec2(reference) - ivec2(at);  // rows, columns
    vector.x = round_shift(disparity * offset.y, s);
    vector.y = round_shift(disparity * arguments.shape.row_scale * offset.x, s + 4u);
  }
  return clamp(vector, ivec2(-bound), ivec2(bound));
}

/// MOT-9: whole samples and eighths of a vector.
uint split_vector(ivec2 vector, bool halved) {
  ivec2 u = vector * (1 << (3u - arguments.shape.vector_precision));
  if (halved) u = (u + 1) >> 1;
  return vector_word(u >> 3, u & 7);
}

/// References of each reference_set, as numbers of K0 to K3 (MOT-7): the first in bits 0-1, the
/// second in bits 2-3, how many in bits 4-5.
const uint kReferenceSets[8] = uint[8](0x10u, 0x24u, 0x28u, 0x11u, 0x12u, 0x29u, 0x2Cu, 0x13u);

/// The motion of block (bx, by) of predictive image `at` (row, column), which is in reference group
/// `own`, into `entry`; an error of annex A, or ok (MOT-4, MOT-10).
uint walk_to_motion(LevelShape level, PlaneShape plane, uvec2 at, ReferenceGroup own, uint bx,
                    uint by, inout BlockEntry entry) {
  const MotionPlaneShape motion_plane = arguments.shape.motion_planes[plane.motion_plane];
  const uvec2 place = uvec2(bx, by) << (arguments.shape.block_log2 + plane.halved);
  const uint image = level.first_image + at.x * level.cols + at.y;
  PaletteEntry palette;
  uint status = walk_to_palette(image, motion_plane, place, level.keyed != 0u, palette);
  if (status != ERROR_OK || palette.choice == kChoiceNone) return status;
  int disparity = palette.explicit_x;
  if (palette.choice <= kChoiceLastNeighbour) {
    status = walk_to_disparity(level.first_image + own.image.x * level.cols + own.image.y,
                               motion_plane, grid_block(motion_plane, place, palette.choice),
                               disparity);
    if (status != ERROR_OK) return status;
  }
  const uint set = kReferenceSets[palette.reference_set];
  entry.count = set >> 4;
  entry.negative = palette.negative;
  for (uint i = 0u; i < entry.count; ++i) {
    const ReferenceGroup k = reference_group(level, at, own, (set >> (2u * i)) & 3u);
    const ivec2 vector = motion_vector(palette, disparity, at, k.image);
    const PackedReference found = PackedReference(reference_base(level, plane, k.group),
                                                  split_vector(vector, plane.halved != 0u));
    if (i == 0u) entry.references[0] = found; else entry.references[1] = found;
  }
  return ERROR_OK;
}
