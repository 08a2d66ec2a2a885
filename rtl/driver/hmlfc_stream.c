/* Streams: the shape of the tree (STR-2 to STR-5, EXT-3, EXT-4), and the checks behind the header
 * (FIL-6, IDX-4, IDX-5, KEY-1). */
#include <string.h>

#include "hmlfc_internal.h"

enum { TILE_BLOCKS = 8, LANES = 64, ROOT_ENTRY_BYTES = 16, GROUP_RECORD_BYTES = 16 };

/* The remainders of all bytes: that of a byte is the sum of those of its bits. */
#define OF_BIT(byte, bit, remainder) ((byte) >> (bit)&1 ? (remainder) : 0u)
#define OF_BYTE(b)                                                                        \
  OF_BIT(b, 0, 0xf26b8303u) ^ OF_BIT(b, 1, 0xe13b70f7u) ^ OF_BIT(b, 2, 0xc79a971fu) ^     \
      OF_BIT(b, 3, 0x8ad958cfu) ^ OF_BIT(b, 4, 0x105ec76fu) ^ OF_BIT(b, 5, 0x20bd8edeu) ^ \
      OF_BIT(b, 6, 0x417b1dbcu) ^ OF_BIT(b, 7, 0x82f63b78u)
#define OF_4(b) OF_BYTE(b), OF_BYTE((b) + 1), OF_BYTE((b) + 2), OF_BYTE((b) + 3)
#define OF_16(b) OF_4(b), OF_4((b) + 4), OF_4((b) + 8), OF_4((b) + 12)
#define OF_64(b) OF_16(b), OF_16((b) + 16), OF_16((b) + 32), OF_16((b) + 48)

uint32_t hmlfc_crc32c(const uint8_t* bytes, size_t count, uint32_t crc) {
  static const uint32_t remainders[256] = {OF_64(0), OF_64(64), OF_64(128), OF_64(192)};
  crc = ~crc;
  for (size_t i = 0; i < count; ++i) {
    crc = crc >> 8 ^ remainders[(crc ^ bytes[i]) & 0xff];
  }
  return ~crc;
}

static int check_limits(const struct hmlfc_stream* s, const struct hmlfc_limits* l,
                        struct hmlfc_error* error) {
  if ((l->block_log2 != 0 && s->block_log2 != l->block_log2) || s->depth > l->depth ||
      s->width > l->view_side || s->height > l->view_side || s->rows > l->grid_side ||
      s->cols > l->grid_side || s->tree_height > l->tree_height) {
    return hmlfc_fail(error, HMLFC_LIMIT_EXCEEDED, 0, 0);
  }
  return HMLFC_OK;
}

/* --- The shape of the tree ------------------------------------------------------------------- */

static uint32_t begin_of_group(const struct hmlfc_stream* s, uint32_t images, uint32_t size,
                               uint32_t group) {
  uint32_t begin = group * size;
  if (hmlfc_has(s, HMLFC_BALANCED_GROUPS)) return group * images / hmlfc_divide_up(images, size);
  return begin < images ? begin : images;
}

static uint32_t reference_of(const struct hmlfc_stream* s, uint32_t images, uint32_t size,
                             uint32_t group) {
  const uint32_t begin = begin_of_group(s, images, size, group);
  return begin + ((begin_of_group(s, images, size, group + 1) - begin - 1) >> 1);
}

void hmlfc_reference_image(const struct hmlfc_stream* stream, unsigned level, uint32_t group_row,
                           uint32_t group_col, uint32_t* row, uint32_t* col) {
  const struct hmlfc_level* l = &stream->levels[level];
  *row = reference_of(stream, l->rows, l->ref_rows, group_row);
  *col = reference_of(stream, l->cols, l->ref_cols, group_col);
}

/* Motion tiles of a plane (MOT-1). */
static uint64_t motion_tiles(const struct hmlfc_stream* s, unsigned plane) {
  const uint32_t side = 1u << s->motion_tile_log2;
  return (uint64_t)hmlfc_divide_up(s->planes[plane].width, side) *
         hmlfc_divide_up(s->planes[plane].height, side);
}

static void add_planes(struct hmlfc_stream* s) {
  const uint32_t b = 1u << s->block_log2;
  for (unsigned p = 0; p < HMLFC_PLANES; ++p) {
    struct hmlfc_plane* plane = &s->planes[p];
    const uint32_t halve = p != 0 && s->chroma_format == 0 ? 2 : 1;
    plane->width = hmlfc_divide_up(s->width, halve);
    plane->height = hmlfc_divide_up(s->height, halve);
    plane->blocks_x = hmlfc_divide_up(plane->width, b);
    plane->blocks_y = hmlfc_divide_up(plane->height, b);
    plane->strips_x = hmlfc_divide_up(plane->blocks_x, 64 / (b * b));
    plane->area_bytes = (uint64_t)plane->strips_x * plane->blocks_y * HMLFC_STRIP_BYTES;
    s->area_image_bytes += plane->area_bytes;
    s->tiles_per_image += (uint64_t)hmlfc_divide_up(plane->blocks_x, TILE_BLOCKS) *
                          hmlfc_divide_up(plane->blocks_y, TILE_BLOCKS);
  }
  if (hmlfc_has(s, HMLFC_MOTION_TILES)) s->tiles_per_image += motion_tiles(s, 0);
  if (hmlfc_has(s, HMLFC_CHROMA_MOTION)) s->tiles_per_image += motion_tiles(s, 1);
}

static void add_levels(struct hmlfc_stream* s) {
  uint32_t rows = s->rows;
  uint32_t cols = s->cols;
  for (unsigned i = 0; i <= s->tree_height; ++i) {
    struct hmlfc_level* level = &s->levels[i];
    level->rows = rows;
    level->cols = cols;
    level->group_rows = hmlfc_divide_up(rows, level->ref_rows);
    level->group_cols = hmlfc_divide_up(cols, level->ref_cols);
    level->is_read = level->keyed || level->group_rows != rows || level->group_cols != cols;
    rows = hmlfc_divide_up(rows, s->cluster_rows);
    cols = hmlfc_divide_up(cols, s->cluster_cols);
  }
  for (unsigned i = s->tree_height + 1u; i-- > 0;) {
    struct hmlfc_level* level = &s->levels[i];
    const uint64_t groups = (uint64_t)level->group_rows * level->group_cols;
    level->first_key = s->key_images;
    level->area_offset = s->area_bytes;
    s->images += (uint64_t)level->rows * level->cols;
    s->key_images += level->keyed ? groups : 0;
    s->area_bytes += groups * s->area_image_bytes;
  }
}

/* --- Sizes, table, checksums ----------------------------------------------------------------- */

static int check_index_sizes(const struct hmlfc_stream* s, struct hmlfc_error* error) {
  const uint64_t tiles = s->images * s->tiles_per_image;
  const uint64_t groups = tiles / LANES + (tiles % LANES != 0);
  const uint64_t entries = groups / LANES + (groups % LANES != 0);
  if (s->sections[1].size != entries * ROOT_ENTRY_BYTES) {
    return hmlfc_fail_in(s, error, HMLFC_BAD_SECTION_SIZE, 2, 0);
  }
  if (s->sections[2].size % GROUP_RECORD_BYTES != 0) {
    return hmlfc_fail_in(s, error, HMLFC_BAD_SECTION_SIZE, 3, 0);
  }
  return HMLFC_OK;
}

/* KEY-1: codestreams follow the table and each other without gaps, up to the end of the section. */
static int check_top_table(const struct hmlfc_stream* s, struct hmlfc_error* error) {
  const uint8_t* top = s->file + s->sections[0].offset;
  const uint64_t size = s->sections[0].size;
  const uint64_t entries = s->key_images * HMLFC_PLANES;
  uint64_t expected = entries * HMLFC_TOP_ENTRY_BYTES;
  if (entries > size / HMLFC_TOP_ENTRY_BYTES)
    return hmlfc_fail_in(s, error, HMLFC_BAD_SECTION_SIZE, 1, 0);
  for (uint64_t i = 0; i < entries; ++i) {
    const uint8_t* entry = top + i * HMLFC_TOP_ENTRY_BYTES;
    const uint32_t bytes = hmlfc_load32(entry + 8);
    if (hmlfc_load(entry, 8) != expected || bytes > size - expected) {
      return hmlfc_fail_in(s, error, HMLFC_BAD_TOP_ENTRY, 1, i * HMLFC_TOP_ENTRY_BYTES);
    }
    expected += bytes;
  }
  if (expected != size) return hmlfc_fail_in(s, error, HMLFC_BAD_SECTION_SIZE, 1, expected);
  return HMLFC_OK;
}

int hmlfc_stream_check_sections(const struct hmlfc_stream* stream, struct hmlfc_error* error) {
  for (int i = hmlfc_first_section(stream); i != 0; i = hmlfc_next_section(i)) {
    const struct hmlfc_section* section = &stream->sections[i - 1];
    if (hmlfc_crc32c(stream->file + section->offset, (size_t)section->size, 0) != section->crc) {
      return hmlfc_fail_in(stream, error, HMLFC_BAD_SECTION_CRC, i, 0);
    }
  }
  return HMLFC_OK;
}

int hmlfc_stream_open(struct hmlfc_stream* stream, const uint8_t* file, size_t bytes,
                      const struct hmlfc_limits* limits, struct hmlfc_error* error) {
  int code;
  memset(stream, 0, sizeof *stream);
  memset(error, 0, sizeof *error);
  stream->file = file;
  stream->bytes = bytes;
  if ((code = hmlfc_load_header(stream, error)) != HMLFC_OK) return code;
  if (limits != NULL && (code = check_limits(stream, limits, error)) != HMLFC_OK) return code;
  add_planes(stream);
  add_levels(stream);
  if ((code = check_index_sizes(stream, error)) != HMLFC_OK) return code;
  return check_top_table(stream, error);
}
