/* The head of a key image's codestream (KEY-2; ISO/IEC 15444-1, annex A). */
#include "hmlfc_driver.h"

enum {
  SOC = 0xff4f,
  SIZ = 0xff51,
  COD = 0xff52,
  QCD = 0xff5c,
  COM = 0xff64,
  SOT = 0xff90,
  SOD = 0xff93,
  EOC = 0xffd9,
  SOT_BYTES = 12,
  GREATEST_TILE = 0x7fffffff
};

struct codestream {
  const uint8_t* bytes;
  size_t count;
};

/* A big-endian field of up to 4 bytes; 0, which is no marker, past the end. */
static uint32_t field(const struct codestream* c, size_t at, unsigned count) {
  uint32_t value = 0;
  if (at > c->count || count > c->count - at) return 0;
  for (unsigned i = 0; i < count; ++i) value = value << 8 | c->bytes[at + i];
  return value;
}

/* One tile of exactly this size at the origin. */
static int is_one_tile(const struct codestream* c, size_t siz, uint32_t width, uint32_t height) {
  const uint32_t tile_width = field(c, siz + 22, 4);
  const uint32_t tile_height = field(c, siz + 26, 4);
  return field(c, siz + 6, 4) == width && field(c, siz + 10, 4) == height &&
         field(c, siz + 14, 4) == 0 && field(c, siz + 18, 4) == 0 && tile_width >= width &&
         tile_width <= GREATEST_TILE && tile_height >= height && tile_height <= GREATEST_TILE &&
         field(c, siz + 30, 4) == 0 && field(c, siz + 34, 4) == 0;
}

/* SIZ with one component of these samples, without extensions. */
static int is_one_component(const struct codestream* c, size_t siz, unsigned bits, int is_signed) {
  return field(c, siz, 2) == SIZ && field(c, siz + 2, 2) == 41 &&
         (field(c, siz + 4, 2) & 0xc000) == 0 && field(c, siz + 38, 2) == 1 &&
         field(c, siz + 40, 1) == (is_signed ? 0x80 : 0) + bits - 1 &&
         field(c, siz + 41, 2) == 0x0101;
}

/* Precincts that are not stated, or stated as 2^15 x 2^15. */
static int has_greatest_precincts(const struct codestream* c, size_t cod) {
  const uint32_t stated = (field(c, cod + 4, 1) & 1) != 0 ? field(c, cod + 9, 1) + 1 : 0;
  if (field(c, cod + 2, 2) != 12 + stated) return 0;
  for (uint32_t i = 0; i < stated; ++i) {
    if (field(c, cod + 14 + i, 1) != 0xff) return 0;
  }
  return 1;
}

/* The progressions, layers, decompositions, code-blocks and styles that there are, no component
 * transform, and the reversible 5/3 transform. */
static int is_allowed_cod(const struct codestream* c, size_t cod) {
  return field(c, cod + 4, 1) <= 7 && field(c, cod + 5, 1) <= 4 && field(c, cod + 6, 2) >= 1 &&
         field(c, cod + 8, 1) == 0 &&
         field(c, cod + 9, 1) <= (field(c, cod + 5, 1) <= 1 ? 32u : 15u) &&
         field(c, cod + 10, 1) + field(c, cod + 11, 1) <= 8 && field(c, cod + 12, 1) <= 63 &&
         field(c, cod + 13, 1) == 1 && has_greatest_precincts(c, cod);
}

/* Exponents alone, one for each subband. */
static int is_allowed_qcd(const struct codestream* c, size_t qcd, uint32_t decompositions) {
  const uint32_t subbands = 3 * decompositions + 1;
  if (field(c, qcd + 2, 2) != 3 + subbands || (field(c, qcd + 4, 1) & 31) != 0) return 0;
  for (uint32_t i = 0; i < subbands; ++i) {
    if ((field(c, qcd + 5 + i, 1) & 7) != 0) return 0;
  }
  return 1;
}

/* Of the only tile-part, which ends at EOC: its length may be 0 for that, and its number of parts
 * open. */
static int is_only_tile_part(const struct codestream* c, size_t sot) {
  const size_t end = c->count - 2;
  const uint32_t bytes = field(c, sot + 6, 4);
  return field(c, sot + 2, 2) == SOT_BYTES - 2 && field(c, sot + 4, 2) == 0 &&
         (bytes == 0 || bytes == end - sot) && field(c, sot + 10, 1) == 0 &&
         field(c, sot + 11, 1) <= 1 && field(c, sot + SOT_BYTES, 2) == SOD &&
         field(c, end, 2) == EOC;
}

int hmlfc_has_key_image_head(const uint8_t* codestream, size_t bytes, uint32_t width,
                             uint32_t height, unsigned bits, int is_signed) {
  const struct codestream c = {codestream, bytes};
  const size_t siz = 2;
  size_t cod = 0; /* 0: none yet */
  size_t qcd = 0;
  if (field(&c, 0, 2) != SOC || !is_one_component(&c, siz, bits, is_signed) ||
      !is_one_tile(&c, siz, width, height)) {
    return 0;
  }
  for (size_t at = siz + 2 + field(&c, siz + 2, 2);; at += 2 + field(&c, at + 2, 2)) {
    switch (field(&c, at, 2)) {
      case COD:
        if (cod != 0 || !is_allowed_cod(&c, at)) return 0;
        cod = at;
        break;
      case QCD:
        if (qcd != 0) return 0;
        qcd = at;
        break;
      case COM:
        break;
      case SOT:
        return cod != 0 && qcd != 0 && is_allowed_qcd(&c, qcd, field(&c, cod + 9, 1)) &&
               is_only_tile_part(&c, at);
      default:
        return 0;
    }
  }
}
