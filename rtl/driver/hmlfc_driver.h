/* The driver of the view unit (docs/view_unit.md, "The driver"): checks a stream, fills the
 * reference area, and decodes views to memory.
 *
 * C99, freestanding but for memset; nothing is allocated, no static data changes, no floating
 * point. Registers, waiting and JPEG 2000 are callbacks, barriers are macros (hmlfc_platform.h).
 * Functions of one unit must not run at the same time; those of a stream only read it.
 *
 * Memory that the unit reads or writes has cache lines of its own. They belong to
 *   the rings             the driver
 *   the stream            the caller until hmlfc_unit_load, then the unit reads them
 *   the area              the caller until hmlfc_unit_load, then the unit
 *   destination, bitmap   the unit from hmlfc_unit_give until its status is taken: without coherent
 *                         memory the caller cleans or invalidates them before, and invalidates
 *                         them before it reads
 *
 * A function that returns int gives 0 (HMLFC_OK), an error of annex A of the specification, or one
 * of the driver's own. */
#ifndef HMLFC_DRIVER_H
#define HMLFC_DRIVER_H

#include <stddef.h>
#include <stdint.h>

#include "hmlfc_platform.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  HMLFC_OK = 0,
  /* Annex A. */
  HMLFC_TRUNCATED = 1,
  HMLFC_BAD_MAGIC = 2,
  HMLFC_BAD_VERSION = 3,
  HMLFC_BAD_HEADER_CRC = 4,
  HMLFC_BAD_PROFILE = 5,
  HMLFC_BAD_FEATURE = 6,
  HMLFC_BAD_HEADER_FIELD = 7,
  HMLFC_BAD_SECTION_TABLE = 8,
  HMLFC_TRAILING_BYTES = 9,
  HMLFC_BAD_SECTION_CRC = 10,
  HMLFC_BAD_SECTION_SIZE = 11,
  HMLFC_BAD_TOP_ENTRY = 12,
  HMLFC_BAD_TOP_IMAGE = 13,
  HMLFC_BAD_TOP_CRC = 14,
  HMLFC_TOP_SAMPLE_RANGE = 15,
  HMLFC_LIMIT_EXCEEDED = 24,
  HMLFC_OUT_OF_MEMORY = 26,
  HMLFC_BUS_ERROR = 27,
  /* The driver's own. */
  HMLFC_BAD_ARGUMENT = 64, /* a buffer is too small, its address no multiple of what it must be or
                              too high, or a field does not fit its bits */
  HMLFC_NO_UNIT = 65,      /* the registers are not those of a view unit */
  HMLFC_TIMEOUT = 66,      /* the callback `wait` gave up, or the watchdog did */
  HMLFC_RING_FULL = 67,    /* take a status first */
  HMLFC_NOTHING_DONE = 68, /* no descriptor is done whose status was not taken */
  HMLFC_BUSY = 69,         /* descriptors were given whose status was not taken */
  HMLFC_WAS_REFUSED = 70   /* the unit refused a descriptor of the driver's */
};

enum { HMLFC_MAX_LEVELS = 16, HMLFC_PLANES = 3, HMLFC_STRIP_BYTES = 128 };

/* --- Streams --------------------------------------------------------------------------------- */

/* Where an error was found. */
struct hmlfc_error {
  int code;
  int section;     /* 0 header, 1 TOP, 2 ROOT, 3 GROUP, 4 TILE, 5 RIG */
  uint64_t offset; /* bytes from the start of the file */
};

/* One level of the tree (STR-3, STR-4). Index 0 has the views. */
struct hmlfc_level {
  uint32_t rows, cols;             /* of images */
  uint32_t group_rows, group_cols; /* of reference groups */
  uint8_t ref_rows, ref_cols;      /* images of a reference group */
  uint8_t keyed;                   /* 1: its reference images are key images (EXT-4) */
  uint8_t is_read;                 /* 1: blocks read its part of the reference area */
  uint64_t first_key;              /* number of its first key image (KEY-1) */
  uint64_t area_offset;            /* of its first reference image, from the area's start */
};

/* One plane of an image (STR-2). */
struct hmlfc_plane {
  uint32_t width, height;      /* samples */
  uint32_t blocks_x, blocks_y; /* of B x B */
  uint32_t strips_x;           /* strips of a row of blocks in the reference area */
  uint64_t area_bytes;         /* of one such plane in the reference area */
};

/* One section of the file (FIL-3). */
struct hmlfc_section {
  uint64_t offset, size; /* bytes */
  uint32_t crc;
};

/* What the header says (FIL-1, EXT-2), and what follows from it. Filled by hmlfc_stream_open. */
struct hmlfc_stream {
  const uint8_t* file; /* must stay where it is */
  size_t bytes;
  uint8_t profile; /* 0 main, 1 extended */
  uint32_t feature_flags;
  uint32_t rows, cols;    /* of views */
  uint32_t width, height; /* of a view, pixels */
  uint8_t depth, chroma_format, block_log2, window;
  uint8_t cluster_rows, cluster_cols, tree_height;
  uint8_t vector_precision, disparity_precision, motion_tile_log2, disparity_grid_log2;
  int8_t row_scale;
  struct hmlfc_level levels[HMLFC_MAX_LEVELS]; /* [0, tree_height] */
  struct hmlfc_plane planes[HMLFC_PLANES];     /* Y, Co, Cg */
  struct hmlfc_section sections[5];            /* TOP, ROOT, GROUP, TILE, RIG if there is one */
  uint64_t images, tiles_per_image, key_images;
  uint64_t area_image_bytes; /* of the three planes of one reference image */
  uint64_t area_bytes;       /* of the reference area */
};

/* The greatest values that a unit takes (FIL-7). */
struct hmlfc_limits {
  uint32_t grid_side;  /* rows and cols */
  uint32_t view_side;  /* width and height */
  uint8_t tree_height; /* [0, 15] */
  uint8_t depth;       /* [8, 12] */
  uint8_t block_log2;  /* the only one; 0: any */
};

/* Checks everything but checksums of sections and content of tiles: the header, `limits` (null:
 * those of the format), the sizes of ROOT and GROUP, the TOP table, in the order of FIL-8. With an
 * error, `error` says where, and the stream must not be used. */
int hmlfc_stream_open(struct hmlfc_stream* stream, const uint8_t* file, size_t bytes,
                      const struct hmlfc_limits* limits, struct hmlfc_error* error);

/* Checks the checksums of the sections (FIL-6). They read the whole file. */
int hmlfc_stream_check_sections(const struct hmlfc_stream* stream, struct hmlfc_error* error);

/* CRC-32C of `bytes`, continuing `crc`, which is 0 at the start (FIL-5). */
uint32_t hmlfc_crc32c(const uint8_t* bytes, size_t count, uint32_t crc);

/* The reference image of group (group_row, group_col) of a level (STR-4, EXT-3), in images. */
void hmlfc_reference_image(const struct hmlfc_stream* stream, unsigned level, uint32_t group_row,
                           uint32_t group_col, uint32_t* row, uint32_t* col);

/* --- The reference area ---------------------------------------------------------------------- */

/* Decodes one JPEG 2000 codestream that hmlfc_has_key_image_head has accepted, of one component of
 * width x height samples of `bits` bits, two's complement if `is_signed`, into `samples`, row by
 * row, each clamped to these bits. Returns 0; HMLFC_OUT_OF_MEMORY; or anything else where its
 * packets do not decode. hmlfc_openjpeg.c has one. */
typedef int (*hmlfc_decode_plane)(void* context, const uint8_t* codestream, size_t bytes,
                                  uint32_t width, uint32_t height, unsigned bits, int is_signed,
                                  int16_t* samples);

/* Where a plane of the reference image of a group lies, in bytes from the area's start. */
uint64_t hmlfc_area_offset(const struct hmlfc_stream* stream, unsigned level, uint32_t group_row,
                           uint32_t group_col, unsigned plane);

/* Whether a codestream has the markers that KEY-2 asks for, for a plane of such samples. */
int hmlfc_has_key_image_head(const uint8_t* codestream, size_t bytes, uint32_t width,
                             uint32_t height, unsigned bits, int is_signed);

/* Memory that software and the unit see. */
struct hmlfc_buffer {
  uint8_t* cpu;
  uint64_t bus; /* address below 2^40 */
  size_t bytes;
};

/* Decodes all key images into `area`, of at least stream->area_bytes bytes that are 0. `samples`
 * has room for `count` samples, at least the width * height of a view. A plane that does not decode
 * (KEY-2 to KEY-4) is stored as its error, which blocks that read it then have: `failed` says how
 * many such planes there are; the first is in `error`, whose code else is 0. */
int hmlfc_fill_key_images(const struct hmlfc_stream* stream, const struct hmlfc_buffer* area,
                          hmlfc_decode_plane decode, void* context, int16_t* samples, size_t count,
                          uint64_t* failed, struct hmlfc_error* error);

/* Packs one plane into strips at `area`; `error` is 0, or the error of all its blocks. */
void hmlfc_pack_plane(const struct hmlfc_plane* plane, unsigned block_log2, const int16_t* samples,
                      int error, uint8_t* area);

/* --- The unit -------------------------------------------------------------------------------- */

/* Access to a unit. */
struct hmlfc_io {
  void* context;
  uint32_t (*read)(void* context, uint32_t offset);
  void (*write)(void* context, uint32_t offset, uint32_t value);
  /* Returns when `irq` is high, or after any time that suits; not 0 gives up. */
  int (*wait)(void* context);
  /* Makes bytes that were written visible to the unit, and those of the unit to the caller, by the
   * whole cache lines that they are in. Null where memory is coherent. */
  void (*clean)(void* context, const void* from, size_t bytes);
  void (*invalidate)(void* context, const void* from, size_t bytes);
};

/* What is stored (docs/view_unit.md). */
enum {
  HMLFC_FORMAT_Y = 0,
  HMLFC_FORMAT_CO = 1,
  HMLFC_FORMAT_CG = 2,
  HMLFC_FORMAT_RGB888 = 4,
  HMLFC_FORMAT_RGB101010 = 5,
  HMLFC_FORMAT_RGB161616 = 6,
  HMLFC_FORMAT_RESIDUALS_Y = 8,
  HMLFC_FORMAT_RESIDUALS_CO = 9,
  HMLFC_FORMAT_RESIDUALS_CG = 10
};

/* A rectangle of a view, and where it goes. The unit checks the fields; none may exceed the width
 * that docs/view_unit.md gives. */
struct hmlfc_descriptor {
  uint32_t tag;
  uint16_t row, col; /* [0, 4095] */
  uint8_t stop_level, format;
  uint16_t x, y, width, height;
  uint64_t destination;
  uint32_t pitch;
  uint64_t bitmap;
};

enum { HMLFC_DONE = 0, HMLFC_BLOCK_ERRORS, HMLFC_REFUSED, HMLFC_BUS, HMLFC_ABORTED };

/* What became of it. */
struct hmlfc_status {
  uint32_t tag;
  uint8_t result;      /* HMLFC_DONE, ... */
  uint8_t first_error; /* of the first block in scan order that has one */
  uint32_t blocks;     /* with errors */
  uint32_t writes;     /* bursts that were answered with an error */
};

/* A unit; its fields are the driver's. */
struct hmlfc_unit {
  struct hmlfc_io io;
  struct hmlfc_buffer rings;
  struct hmlfc_limits limits; /* for hmlfc_stream_open; read it after hmlfc_unit_open */
  uint16_t ring_size, producer, taken;
  uint8_t beat; /* bytes */
  uint32_t watchdog;
};

/* Bytes of the rings for ring_size descriptors: each in whole cache lines. */
#define HMLFC_RING_BYTES(ring_size, bytes)                                            \
  ((sizeof(uint8_t[bytes]) * (ring_size) + HMLFC_CACHE_LINE - 1) / HMLFC_CACHE_LINE * \
   HMLFC_CACHE_LINE)
#define HMLFC_RINGS_BYTES(ring_size) \
  (HMLFC_RING_BYTES(ring_size, 64) + HMLFC_RING_BYTES(ring_size, 16))

/* Takes a unit in any state, resets it, and begins to let it take descriptors. `rings` has
 * HMLFC_RINGS_BYTES(ring_size) bytes at a multiple of HMLFC_CACHE_LINE; ring_size is a power of two
 * in [1, 32768]. */
int hmlfc_unit_open(struct hmlfc_unit* unit, const struct hmlfc_io* io,
                    const struct hmlfc_buffer* rings, unsigned ring_size);

/* Resets the unit, when all that it asked of the memory has come, and begins anew: forgotten are
 * the stream, descriptors that were given, and which events are enabled. HMLFC_TIMEOUT: the memory
 * does not answer, and may still be written; then only a reset of the chip helps. */
int hmlfc_unit_reset(struct hmlfc_unit* unit);

/* Lets functions that wait give up where the memory owes the unit an answer and nothing has moved
 * for `clocks` of it, less than 2^24; 0, as after open, for ever. */
void hmlfc_unit_set_watchdog(struct hmlfc_unit* unit, uint32_t clocks);

/* Lets the unit read the stream, whose first byte has the address `stream_bus`, and the area, of at
 * least stream->area_bytes bytes; its address is a multiple of 16 and of a beat, that of the area
 * of 128. Up to 15 bytes and a beat past the end of the stream may be read. Returns the unit's
 * error, such as HMLFC_LIMIT_EXCEEDED for a stream that was not opened with unit->limits. Nothing
 * may be under way; descriptors that were given wait. */
int hmlfc_unit_load(struct hmlfc_unit* unit, const struct hmlfc_stream* stream, uint64_t stream_bus,
                    const struct hmlfc_buffer* area);

/* Lets the unit decode the residual references into the area that was loaded with the stream.
 * `failed` counts blocks that do not decode: they are stored as their error. It returns when
 * nothing is under way, also with an error; with HMLFC_TIMEOUT the unit was reset. */
int hmlfc_unit_fill_residuals(struct hmlfc_unit* unit, const struct hmlfc_stream* stream,
                              const struct hmlfc_buffer* area, uint64_t* failed);

/* Puts a descriptor into the ring. */
int hmlfc_unit_give(struct hmlfc_unit* unit, const struct hmlfc_descriptor* descriptor);

/* The status of the first descriptor that is done and was not taken, or HMLFC_NOTHING_DONE. */
int hmlfc_unit_take(struct hmlfc_unit* unit, struct hmlfc_status* status);

/* The same, waiting for one. */
int hmlfc_unit_wait(struct hmlfc_unit* unit, struct hmlfc_status* status);

/* Lets `irq` rise with these events, bits of INTERRUPT_STATUS. */
void hmlfc_unit_enable_events(struct hmlfc_unit* unit, uint32_t events);

/* The events since the last call; clears them. For an interrupt handler. */
uint32_t hmlfc_unit_events(struct hmlfc_unit* unit);

/* Waits until all given descriptors are done, also those that an abort has left, and the queue has
 * stopped. */
int hmlfc_unit_drain(struct hmlfc_unit* unit);

/* Ends the descriptor under way, and stops. What follows in the ring stays there. */
int hmlfc_unit_abort(struct hmlfc_unit* unit);

/* Goes on after drain or abort. */
void hmlfc_unit_resume(struct hmlfc_unit* unit);

#ifdef __cplusplus
}
#endif

#endif
