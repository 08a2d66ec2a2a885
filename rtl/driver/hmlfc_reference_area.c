/* Key images and their strips in the reference area (KEY-1 to KEY-4, EXT-6; docs/decode_unit.md,
 * "The reference area"). */
#include <string.h>

#include "hmlfc_internal.h"

enum { STRIP_SAMPLES = 64, QUARTER = 16, WIDTH_BITS = 4, HEAD_BITS = 20, RAW = 15, RAW_BITS = 14 };

uint64_t hmlfc_area_offset(const struct hmlfc_stream* stream, unsigned level, uint32_t group_row,
                           uint32_t group_col, unsigned plane) {
  const struct hmlfc_level* l = &stream->levels[level];
  const uint64_t image = (uint64_t)group_row * l->group_cols + group_col;
  uint64_t offset = l->area_offset + image * stream->area_image_bytes;
  for (unsigned p = 0; p < plane; ++p) offset += stream->planes[p].area_bytes;
  return offset;
}

/* --- Strips ---------------------------------------------------------------------------------- */

/* Sets `count` bits, of bytes that are 0 there (CNV-4). */
static void put_bits(uint8_t* bytes, unsigned at, unsigned count, uint32_t value) {
  for (unsigned done = 0; done < count;) {
    const unsigned shift = (at + done) % 8;
    const unsigned part = count - done < 8 - shift ? count - done : 8 - shift;
    const uint32_t bits = (value >> done) & ((1u << part) - 1);
    bytes[(at + done) / 8] = (uint8_t)(bytes[(at + done) / 8] | bits << shift);
    done += part;
  }
}

static unsigned bits_of(uint32_t value) {
  unsigned bits = 0;
  for (; value != 0; value >>= 1) ++bits;
  return bits;
}

/* Packs a quarter, number `q`, of a strip: its head, and its samples from bit `at` on. Returns the
 * bit after them. With `error` the samples are those of blocks that could not be decoded. */
static unsigned pack_quarter(const int16_t* samples, unsigned q, int error, unsigned at,
                             uint8_t* place) {
  int32_t base = samples[0];
  int32_t most = samples[0];
  unsigned width;
  for (unsigned i = 1; i < QUARTER; ++i) {
    if (samples[i] < base) base = samples[i];
    if (samples[i] > most) most = samples[i];
  }
  width = error ? RAW : bits_of((uint32_t)(most - base));
  put_bits(place, q * HEAD_BITS, WIDTH_BITS, width);
  put_bits(place, q * HEAD_BITS + WIDTH_BITS, 16, error ? 15u : (uint32_t)base & 0xffff);
  if (error) {
    width = RAW_BITS;
    base = 0;
  }
  for (unsigned i = 0; i < QUARTER; ++i, at += width) {
    put_bits(place, at, width, (uint32_t)(samples[i] - base) & 0x3fff);
  }
  return at;
}

static void pack_strip(const int16_t samples[STRIP_SAMPLES], int error, uint8_t* place) {
  unsigned at = STRIP_SAMPLES / QUARTER * HEAD_BITS;
  memset(place, 0, HMLFC_STRIP_BYTES);
  for (unsigned q = 0; q < STRIP_SAMPLES / QUARTER; ++q) {
    at = pack_quarter(samples + q * QUARTER, q, error, at, place);
  }
}

/* Strip `s` of a row of blocks: samples outside the plane are 0, blocks outside repeat the first
 * sample of the strip. */
static void gather(const struct hmlfc_plane* plane, unsigned block_log2, const int16_t* samples,
                   uint32_t s, uint32_t by, int16_t strip[STRIP_SAMPLES]) {
  const uint32_t b = 1u << block_log2;
  for (uint32_t i = 0; i < STRIP_SAMPLES; ++i) {
    const uint32_t bx = s * (STRIP_SAMPLES / (b * b)) + i / (b * b);
    const uint32_t x = bx * b + i % b;
    const uint32_t y = by * b + i / b % b;
    if (bx >= plane->blocks_x) {
      strip[i] = strip[0];
    } else if (x < plane->width && y < plane->height) {
      strip[i] = samples[(size_t)y * plane->width + x];
    } else {
      strip[i] = 0;
    }
  }
}

void hmlfc_pack_plane(const struct hmlfc_plane* plane, unsigned block_log2, const int16_t* samples,
                      int error, uint8_t* area) {
  int16_t strip[STRIP_SAMPLES];
  for (unsigned i = 0; i < STRIP_SAMPLES; ++i) strip[i] = (int16_t)error;
  for (uint32_t by = 0; by < plane->blocks_y; ++by) {
    for (uint32_t s = 0; s < plane->strips_x; ++s, area += HMLFC_STRIP_BYTES) {
      if (error == 0) gather(plane, block_log2, samples, s, by, strip);
      pack_strip(strip, error != 0, area);
    }
  }
}

/* --- Key images ------------------------------------------------------------------------------ */

static uint32_t crc_of_samples(const int16_t* samples, size_t count) {
  uint32_t crc = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint8_t bytes[2] = {(uint8_t)(samples[i] & 0xff), (uint8_t)((samples[i] >> 8) & 0xff)};
    crc = hmlfc_crc32c(bytes, 2, crc);
  }
  return crc;
}

/* Decodes plane `p` of key image number `key`. hmlfc_stream_open has checked the entry, but the
 * memory of the stream may have changed since. */
static int decode_key_plane(const struct hmlfc_stream* s, uint64_t key, unsigned p,
                            hmlfc_decode_plane decode, void* context, int16_t* samples,
                            struct hmlfc_error* error) {
  const struct hmlfc_plane* plane = &s->planes[p];
  const uint64_t at = (key * HMLFC_PLANES + p) * HMLFC_TOP_ENTRY_BYTES;
  const uint8_t* top = s->file + s->sections[0].offset;
  const uint64_t offset = hmlfc_load(top + at, 8);
  const uint32_t bytes = hmlfc_load32(top + at + 8);
  const size_t count = (size_t)plane->width * plane->height;
  const unsigned bits = s->depth + (p != 0 ? 1u : 0u);
  const int hi = (1 << s->depth) - 1;
  const int lo = p == 0 ? 0 : -hi;
  int outside = 0;
  int code;
  if (offset > s->sections[0].size || bytes > s->sections[0].size - offset) {
    return hmlfc_fail_in(s, error, HMLFC_BAD_TOP_ENTRY, 1, at);
  }
  if (!hmlfc_has_key_image_head(top + offset, bytes, plane->width, plane->height, bits, p != 0)) {
    return hmlfc_fail_in(s, error, HMLFC_BAD_TOP_IMAGE, 1, offset);
  }
  code = decode(context, top + offset, bytes, plane->width, plane->height, bits, p != 0, samples);
  if (code != 0) {
    if (code != HMLFC_OUT_OF_MEMORY) code = HMLFC_BAD_TOP_CRC;
    return hmlfc_fail_in(s, error, code, 1, at);
  }
  for (size_t i = 0; i < count; ++i) {
    const int value = samples[i];
    if (value >= lo && value <= hi) continue;
    outside = 1;
    if (hmlfc_has(s, HMLFC_LOSSY_KEYS)) samples[i] = (int16_t)(value < lo ? lo : hi);
  }
  if (crc_of_samples(samples, count) != hmlfc_load32(top + at + 12)) {
    return hmlfc_fail_in(s, error, HMLFC_BAD_TOP_CRC, 1, at);
  }
  if (outside && !hmlfc_has(s, HMLFC_LOSSY_KEYS)) {
    return hmlfc_fail_in(s, error, HMLFC_TOP_SAMPLE_RANGE, 1, offset);
  }
  return HMLFC_OK;
}

int hmlfc_fill_key_images(const struct hmlfc_stream* stream, const struct hmlfc_buffer* area,
                          hmlfc_decode_plane decode, void* context, int16_t* samples, size_t count,
                          uint64_t* failed, struct hmlfc_error* error) {
  *failed = 0;
  memset(error, 0, sizeof *error);
  if (area->bytes < stream->area_bytes || count < (uint64_t)stream->width * stream->height) {
    return HMLFC_BAD_ARGUMENT;
  }
  for (unsigned l = stream->tree_height + 1u; l-- > 0;) {
    const struct hmlfc_level* level = &stream->levels[l];
    const uint64_t groups = (uint64_t)level->group_rows * level->group_cols;
    uint8_t* at = area->cpu + level->area_offset;
    for (uint64_t i = 0; level->keyed && i < groups * HMLFC_PLANES; ++i) {
      const unsigned p = (unsigned)(i % HMLFC_PLANES);
      struct hmlfc_error plane_error;
      const int code = decode_key_plane(stream, level->first_key + i / HMLFC_PLANES, p, decode,
                                        context, samples, &plane_error);
      if (code != HMLFC_OK && (*failed)++ == 0) *error = plane_error;
      hmlfc_pack_plane(&stream->planes[p], stream->block_log2, samples, code, at);
      at += stream->planes[p].area_bytes;
    }
  }
  return HMLFC_OK;
}
