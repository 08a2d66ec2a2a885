/* The header: FIL-1 to FIL-4, EXT-1, EXT-2, RIG-1. */
#include "hmlfc_internal.h"

enum {
  AT_VERSION = 8,
  AT_PROFILE = 9,
  AT_HEADER_BYTES = 10,
  AT_FEATURE_FLAGS = 12,
  AT_ROWS = 16,
  AT_DEPTH = 28,
  AT_EXTENDED = 35,
  AT_RESERVED_EXTENDED = 40,
  AT_LEVELS = 44,
  LEVEL_BYTES = 4,
  SECTION_BYTES = 24,
  CRC_BYTES = 4
};

/* Up to the section entries. */
static uint32_t table_offset(unsigned tree_height) {
  return AT_LEVELS + LEVEL_BYTES * (tree_height + 1);
}

static uint32_t header_bytes(unsigned tree_height, unsigned sections) {
  return table_offset(tree_height) + sections * SECTION_BYTES + CRC_BYTES;
}

static unsigned section_count(const struct hmlfc_stream* s) {
  return hmlfc_has(s, HMLFC_CAMERA_RIG) ? 5 : 4;
}

/* FIL-4 up to the checksum, and the profile. */
static int check_envelope(const uint8_t* file, size_t bytes, struct hmlfc_error* error) {
  static const uint8_t magic[8] = {0x89, 'H', 'M', 'L', 'F', 'C', 0x0d, 0x0a};
  size_t size;
  if (bytes < AT_FEATURE_FLAGS) return hmlfc_fail(error, HMLFC_TRUNCATED, 0, bytes);
  for (unsigned i = 0; i < sizeof magic; ++i) {
    if (file[i] != magic[i]) return hmlfc_fail(error, HMLFC_BAD_MAGIC, 0, 0);
  }
  if (file[AT_VERSION] != 1) return hmlfc_fail(error, HMLFC_BAD_VERSION, 0, AT_VERSION);
  size = (size_t)hmlfc_load(file + AT_HEADER_BYTES, 2);
  if (size < header_bytes(0, 4)) return hmlfc_fail(error, HMLFC_TRUNCATED, 0, AT_HEADER_BYTES);
  if (size > bytes) return hmlfc_fail(error, HMLFC_TRUNCATED, 0, bytes);
  if (hmlfc_load32(file + size - CRC_BYTES) != hmlfc_crc32c(file, size - CRC_BYTES, 0)) {
    return hmlfc_fail(error, HMLFC_BAD_HEADER_CRC, 0, size - CRC_BYTES);
  }
  if (file[AT_PROFILE] > 1) return hmlfc_fail(error, HMLFC_BAD_PROFILE, 0, AT_PROFILE);
  return HMLFC_OK;
}

static void load_fields(struct hmlfc_stream* s) {
  const uint8_t* f = s->file;
  s->profile = f[AT_PROFILE];
  s->feature_flags = hmlfc_load32(f + AT_FEATURE_FLAGS);
  s->rows = (uint32_t)hmlfc_load(f + AT_ROWS, 2);
  s->cols = (uint32_t)hmlfc_load(f + AT_ROWS + 2, 2);
  s->width = hmlfc_load32(f + AT_ROWS + 4);
  s->height = hmlfc_load32(f + AT_ROWS + 8);
  s->depth = f[AT_DEPTH];
  s->chroma_format = f[AT_DEPTH + 1];
  s->block_log2 = f[AT_DEPTH + 2];
  s->window = f[AT_DEPTH + 3];
  s->cluster_rows = f[AT_DEPTH + 4];
  s->cluster_cols = f[AT_DEPTH + 5];
  s->tree_height = f[AT_DEPTH + 6];
  if (s->profile == 0) return;
  s->vector_precision = f[AT_EXTENDED];
  s->disparity_precision = f[AT_EXTENDED + 1];
  s->motion_tile_log2 = f[AT_EXTENDED + 2];
  s->disparity_grid_log2 = f[AT_EXTENDED + 3];
  s->row_scale = (int8_t)(f[AT_EXTENDED + 4] < 128 ? f[AT_EXTENDED + 4] : f[AT_EXTENDED + 4] - 256);
}

static int features_are_valid(const struct hmlfc_stream* s) {
  const uint32_t need_motion_tiles = 1u << HMLFC_SUBPEL_VECTORS | 1u << HMLFC_SHARED_DISPARITY |
                                     1u << HMLFC_TWO_REFERENCES | 1u << HMLFC_CHROMA_MOTION;
  if (s->profile == 0) return s->feature_flags == 0;
  if (s->feature_flags >> HMLFC_FEATURE_COUNT != 0) return 0;
  return hmlfc_has(s, HMLFC_MOTION_TILES) || (s->feature_flags & need_motion_tiles) == 0;
}

/* The first field outside its interval (FIL-1, EXT-2), or 0. */
static unsigned bad_field(const struct hmlfc_stream* s) {
  const int height = s->cluster_rows * s->cluster_cols < 2 ? 0 : 15;
  const int shared = hmlfc_has(s, HMLFC_SHARED_DISPARITY);
  const int subpel = hmlfc_has(s, HMLFC_SUBPEL_VECTORS);
  const int tiles = hmlfc_has(s, HMLFC_MOTION_TILES);
  const struct {
    int64_t value, lo, hi;
    unsigned at;
  } fields[] = {{s->rows, 1, 4096, 16},
                {s->cols, 1, 4096, 18},
                {s->width, 1, 65536, 20},
                {s->height, 1, 65536, 24},
                {s->depth, 8, 12, 28},
                {s->chroma_format, 0, 1, 29},
                {s->block_log2, 1, 3, 30},
                {s->window, 0, 127, 31},
                {s->cluster_rows, 1, 255, 32},
                {s->cluster_cols, 1, 255, 33},
                {s->tree_height, 0, height, 34},
                {s->vector_precision, subpel ? 1 : 0, subpel ? 3 : 0, 35},
                {s->disparity_precision, shared ? s->vector_precision : 0, shared ? 5 : 0, 36},
                {s->motion_tile_log2, tiles ? 5 : 0, tiles ? 7 : 0, 37},
                {s->disparity_grid_log2, shared ? 2 : 0, shared ? 5 : 0, 38},
                {s->row_scale, shared ? -127 : 0, shared ? 127 : 0, 39}};
  for (unsigned i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
    if (fields[i].value < fields[i].lo || fields[i].value > fields[i].hi) return fields[i].at;
  }
  return 0;
}

static int check_fields(const struct hmlfc_stream* s, struct hmlfc_error* error) {
  const unsigned reserved = s->profile == 0 ? AT_EXTENDED : AT_RESERVED_EXTENDED;
  unsigned bad;
  if (!features_are_valid(s)) return hmlfc_fail(error, HMLFC_BAD_FEATURE, 0, AT_FEATURE_FLAGS);
  bad = bad_field(s);
  if (bad != 0) return hmlfc_fail(error, HMLFC_BAD_HEADER_FIELD, 0, bad);
  for (unsigned at = reserved; at < AT_LEVELS; ++at) {
    if (s->file[at] != 0) return hmlfc_fail(error, HMLFC_BAD_HEADER_FIELD, 0, reserved);
  }
  if (hmlfc_load(s->file + AT_HEADER_BYTES, 2) != header_bytes(s->tree_height, section_count(s))) {
    return hmlfc_fail(error, HMLFC_BAD_HEADER_FIELD, 0, AT_HEADER_BYTES);
  }
  return HMLFC_OK;
}

/* The table of levels, the top level's entry first (FIL-2). */
static int load_levels(struct hmlfc_stream* s, struct hmlfc_error* error) {
  for (unsigned i = 0; i <= s->tree_height; ++i) {
    const unsigned at = AT_LEVELS + i * LEVEL_BYTES;
    const uint8_t* entry = s->file + at;
    struct hmlfc_level* level = &s->levels[s->tree_height - i];
    const uint8_t most[4] = {255, 255, i != 0 && hmlfc_has(s, HMLFC_LEVEL_KEYS), 0};
    for (unsigned k = 0; k < LEVEL_BYTES; ++k) {
      if (entry[k] > most[k] || (k < 2 && entry[k] == 0)) {
        return hmlfc_fail(error, HMLFC_BAD_HEADER_FIELD, 0, at + k);
      }
    }
    level->ref_rows = entry[0];
    level->ref_cols = entry[1];
    level->keyed = i == 0 || entry[2] != 0;
  }
  return HMLFC_OK;
}

/* FIL-3: sections follow each other without gaps, up to the end of the file. An end past 2^64 is
 * past the end of the file; no section begins after it. */
static int load_sections(struct hmlfc_stream* s, struct hmlfc_error* error) {
  uint32_t at = table_offset(s->tree_height);
  uint64_t expected = header_bytes(s->tree_height, section_count(s));
  int ends = 1;
  for (int i = hmlfc_first_section(s); i != 0; i = hmlfc_next_section(i)) {
    const uint8_t* entry = s->file + at;
    struct hmlfc_section* section = &s->sections[i - 1];
    section->crc = hmlfc_load32(entry + 4);
    section->offset = hmlfc_load(entry + 8, 8);
    section->size = hmlfc_load(entry + 16, 8);
    if (hmlfc_load32(entry) != (uint32_t)i || !ends || section->offset != expected) {
      return hmlfc_fail(error, HMLFC_BAD_SECTION_TABLE, 0, at);
    }
    ends = section->size <= UINT64_MAX - section->offset;
    expected = ends ? section->offset + section->size : 0;
    at += SECTION_BYTES;
  }
  for (int i = hmlfc_first_section(s); i != 0; i = hmlfc_next_section(i)) {
    const struct hmlfc_section* section = &s->sections[i - 1];
    if (section->size > s->bytes || section->offset > s->bytes - section->size) {
      return hmlfc_fail(error, HMLFC_TRUNCATED, i, s->bytes);
    }
  }
  if (expected != s->bytes) return hmlfc_fail(error, HMLFC_TRAILING_BYTES, 4, expected);
  return HMLFC_OK;
}

int hmlfc_load_header(struct hmlfc_stream* stream, struct hmlfc_error* error) {
  int code = check_envelope(stream->file, stream->bytes, error);
  if (code != HMLFC_OK) return code;
  load_fields(stream);
  if ((code = check_fields(stream, error)) != HMLFC_OK) return code;
  if ((code = load_levels(stream, error)) != HMLFC_OK) return code;
  return load_sections(stream, error);
}
