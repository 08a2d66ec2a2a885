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
  SOT_BYTES = 12
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

/* One component and one tile of exactly this size at the origin. */
static int is_one_tile(const struct codestream* c, size_t siz, uint32_t width, uint32_t height) {
  return field(c, siz, 2) == SIZ && field(c, siz + 6, 4) == width &&
         field(c, siz + 10, 4) == height && field(c, siz + 14, 4) == 0 &&
         field(c, siz + 18, 4) == 0 && field(c, siz + 22, 4) >= width &&
         field(c, siz + 26, 4) >= height && field(c, siz + 30, 4) == 0 &&
         field(c, siz + 34, 4) == 0 && field(c, siz + 38, 2) == 1;
}

/* The largest precincts and the reversible 5/3 transform. */
static int is_reversible(const struct codestream* c, size_t cod) {
  return (field(c, cod + 4, 1) & 1) == 0 && field(c, cod + 13, 1) == 1;
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
                             uint32_t height) {
  const struct codestream c = {codestream, bytes};
  const size_t siz = 2;
  unsigned cods = 0;
  unsigned qcds = 0;
  if (field(&c, 0, 2) != SOC || !is_one_tile(&c, siz, width, height)) return 0;
  for (size_t at = siz + 2 + field(&c, siz + 2, 2);; at += 2 + field(&c, at + 2, 2)) {
    switch (field(&c, at, 2)) {
      case COD:
        if (cods++ != 0 || !is_reversible(&c, at)) return 0;
        break;
      case QCD:
        if (qcds++ != 0) return 0;
        break;
      case COM:
        break;
      case SOT:
        return cods == 1 && qcds == 1 && is_only_tile_part(&c, at);
      default:
        return 0;
    }
  }
}
