/* What the driver's files share. */
#ifndef HMLFC_INTERNAL_H
#define HMLFC_INTERNAL_H

#include "hmlfc_driver.h"

/* Bits of feature_flags (EXT-1). */
enum {
  HMLFC_MOTION_TILES = 1,
  HMLFC_SUBPEL_VECTORS = 2,
  HMLFC_SHARED_DISPARITY = 3,
  HMLFC_TWO_REFERENCES = 4,
  HMLFC_CHROMA_MOTION = 5,
  HMLFC_LOSSY_KEYS = 6,
  HMLFC_LEVEL_KEYS = 7,
  HMLFC_BALANCED_GROUPS = 8,
  HMLFC_CAMERA_RIG = 9,
  HMLFC_FEATURE_COUNT = 10
};

/* Bytes of an entry of the TOP table (KEY-1). */
enum { HMLFC_TOP_ENTRY_BYTES = 16 };

/* Reads and checks the header into a stream that has `file` and `bytes` and else 0: FIL-1 to FIL-4,
 * EXT-1, EXT-2. */
int hmlfc_load_header(struct hmlfc_stream* stream, struct hmlfc_error* error);

/* A little-endian field. */
static inline uint64_t hmlfc_load(const uint8_t* bytes, unsigned count) {
  uint64_t value = 0;
  for (unsigned i = 0; i < count; ++i) value |= (uint64_t)bytes[i] << (8 * i);
  return value;
}

static inline uint32_t hmlfc_load32(const uint8_t* bytes) { return (uint32_t)hmlfc_load(bytes, 4); }

static inline uint32_t hmlfc_divide_up(uint32_t a, uint32_t b) { return a / b + (a % b != 0); }

static inline int hmlfc_has(const struct hmlfc_stream* stream, unsigned feature) {
  return (stream->feature_flags >> feature & 1) != 0;
}

/* Types of sections in the order of the file: 5 (RIG) if there is one, 1, 2, 3, 4, then 0 (FIL-1).
 */
static inline int hmlfc_first_section(const struct hmlfc_stream* stream) {
  return hmlfc_has(stream, HMLFC_CAMERA_RIG) ? 5 : 1;
}

static inline int hmlfc_next_section(int section) {
  return section == 5 ? 1 : section == 4 ? 0 : section + 1;
}

static inline int hmlfc_fail(struct hmlfc_error* error, int code, int section, uint64_t offset) {
  error->code = code;
  error->section = section;
  error->offset = offset;
  return code;
}

/* The same at byte `at` of a section. */
static inline int hmlfc_fail_in(const struct hmlfc_stream* stream, struct hmlfc_error* error,
                                int code, int section, uint64_t at) {
  return hmlfc_fail(error, code, section, stream->sections[section - 1].offset + at);
}

#endif
