/** @file
 * HMLFC light fields from C99: open a stream, decode a block, a rectangle or a view, render frames.
 *
 * Structures. Those with the member struct_size can grow in later versions: set it to the size of
 * the structure as you compiled it, and every other member; 0 is always the default. A library that
 * is older refuses members it does not know unless they are 0; a newer one takes what is missing as
 * 0. All other types are opaque.
 *
 * Errors. A function that returns int gives a hmlfc_status: 0, an error of annex A of the
 * specification by its number, or one of the library's own. `failure` may be null; else it receives
 * the status, the place in the stream and a line of text, whatever the status is. After a failure
 * outputs have no meaning, and a handle that was to be made is null. No exception leaves a
 * function, and every argument is checked but the sizes of what pointers point to.
 *
 * Threads. Every function may be called by any thread. Several threads may use one decoder at once;
 * a renderer serves one call at a time. A handle is closed when no other thread uses it.
 *
 * Samples are exact: the specification leaves nothing open, and neither threads nor processors
 * change them. */
#ifndef HMLFC_HMLFC_H
#define HMLFC_HMLFC_H

#include <stddef.h>
#include <stdint.h>

/** In front of each function of this interface. */
#if defined(__GNUC__) || defined(__clang__)
#define HMLFC_C_EXPORT __attribute__((visibility("default")))
#else
#define HMLFC_C_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What a function returns. */
typedef enum hmlfc_status {
  HMLFC_STATUS_OK = 0,
  HMLFC_STATUS_TRUNCATED = 1, /**< this and those up to 27: annex A */
  HMLFC_STATUS_BAD_MAGIC = 2,
  HMLFC_STATUS_BAD_VERSION = 3,
  HMLFC_STATUS_BAD_HEADER_CRC = 4,
  HMLFC_STATUS_BAD_PROFILE = 5,
  HMLFC_STATUS_BAD_FEATURE = 6,
  HMLFC_STATUS_BAD_HEADER_FIELD = 7,
  HMLFC_STATUS_BAD_SECTION_TABLE = 8,
  HMLFC_STATUS_TRAILING_BYTES = 9,
  HMLFC_STATUS_BAD_SECTION_CRC = 10,
  HMLFC_STATUS_BAD_SECTION_SIZE = 11,
  HMLFC_STATUS_BAD_TOP_ENTRY = 12,
  HMLFC_STATUS_BAD_TOP_IMAGE = 13,
  HMLFC_STATUS_BAD_TOP_CRC = 14,
  HMLFC_STATUS_TOP_SAMPLE_RANGE = 15,
  HMLFC_STATUS_BAD_ROOT_ENTRY = 16,
  HMLFC_STATUS_BAD_GROUP_RECORD = 17,
  HMLFC_STATUS_BAD_TILE_OFFSET = 18,
  HMLFC_STATUS_TILE_OVERRUN = 19,
  HMLFC_STATUS_MASK_OUTSIDE = 20,
  HMLFC_STATUS_BAD_MODE = 21,
  HMLFC_STATUS_BAD_LEVELS = 22,
  HMLFC_STATUS_VECTOR_RANGE = 23,
  HMLFC_STATUS_LIMIT_EXCEEDED = 24,
  HMLFC_STATUS_BAD_REQUEST = 25, /**< a place, rectangle or stop level that the stream lacks */
  HMLFC_STATUS_OUT_OF_MEMORY = 26,
  HMLFC_STATUS_BUS_ERROR = 27,    /**< the function of a hmlfc_source failed; else of hardware */
  HMLFC_STATUS_BAD_ARGUMENT = 64, /**< null, too small a buffer, a value outside its range */
  HMLFC_STATUS_NO_FILE = 65,      /**< the file cannot be read; the text has the reason */
  HMLFC_STATUS_BAD_CAMERA = 66,   /**< an input of the camera; the text names it (CAM-3) */
  HMLFC_STATUS_INTERNAL = 67      /**< a defect of the library */
} hmlfc_status;

/** Bytes of the text of a failure, its final 0 included. */
#define HMLFC_FAILURE_TEXT 160

/** What went wrong and where. */
typedef struct hmlfc_failure {
  size_t struct_size;            /**< sizeof(hmlfc_failure); the one member that you set */
  uint64_t offset;               /**< bytes from the start of the stream; 0 without a place */
  int32_t status;                /**< a hmlfc_status */
  int32_t section;               /**< 0 header, 1 TOP, 2 ROOT, 3 GROUP, 4 TILE, 5 RIG */
  char text[HMLFC_FAILURE_TEXT]; /**< one line for people, empty for success */
} hmlfc_failure;

/** The version of the library, "MAJOR.MINOR.PATCH"; a string that lives as long as the library. */
HMLFC_C_EXPORT const char* hmlfc_version(void);

/** The name of a status, such as "bad_magic", as annex A has it; "unknown_status" for a number that
 * is none. The string lives as long as the library. */
HMLFC_C_EXPORT const char* hmlfc_status_name(int status);

/** What a status means, one line without full stop. The string lives as long as the library. */
HMLFC_C_EXPORT const char* hmlfc_status_meaning(int status);

/** An open stream. */
typedef struct hmlfc_decoder hmlfc_decoder;

/** How to open a stream. */
typedef struct hmlfc_open_options {
  size_t struct_size;         /**< sizeof(hmlfc_open_options) */
  uint64_t max_plane_samples; /**< refuse larger views, width * height (FIL-7); 0: 2^30 */
  uint32_t skip_sections;     /**< 1: do not check the CRC of sections, which reads all of the
                                   stream (FIL-6); else 0 */
  uint32_t reserved;          /**< 0 */
  uint64_t max_code_blocks;   /**< refuse planes of key images with more code-blocks (KEY-2), which
                                   take up to 2 KiB each (FIL-7); 0: 2^19 */
} hmlfc_open_options;

/** Opens the stream of `size` bytes at `bytes`, which must live, unchanged, until its decoder and
 * the renderers on it are closed. `options` may be null. Errors: those of FIL-8. */
HMLFC_C_EXPORT int hmlfc_open_memory(const uint8_t* bytes, size_t size,
                                     const hmlfc_open_options* options, hmlfc_decoder** decoder,
                                     hmlfc_failure* failure);

/** Opens the stream in the regular file `path`, which is mapped: nobody may shorten it meanwhile.
 * `options` may be null. Errors: no_file; those of FIL-8. */
HMLFC_C_EXPORT int hmlfc_open_file(const char* path, const hmlfc_open_options* options,
                                   hmlfc_decoder** decoder, hmlfc_failure* failure);

/** Bytes of a stream that are wanted: [offset, offset + size), to be written to `data`. */
typedef struct hmlfc_read {
  uint64_t offset; /**< from the start of the stream */
  size_t size;     /**< above 0 */
  uint8_t* data;   /**< room for them */
} hmlfc_read;

/** Writes all `count` reads, ascending and apart, and returns 0; anything else is a failure. */
typedef int (*hmlfc_read_function)(void* user, const hmlfc_read* reads, size_t count);

/** A stream whose bytes a function of the caller fetches. */
typedef struct hmlfc_source {
  size_t struct_size;       /**< sizeof(hmlfc_source) */
  uint64_t size;            /**< bytes of the stream */
  hmlfc_read_function read; /**< never null */
  void* user;               /**< its first argument */
  uint64_t cache_bytes;     /**< of the stream kept between calls of this interface; 0: 2^28 */
} hmlfc_source;

/** Opens the stream of `source`; with skip_sections it fetches only what a call needs. source->read
 * is called within the functions of the decoder and its renderers, by any thread of theirs, but by
 * one at a time, until all are closed. It must return, and call no function on these handles. Once
 * it has failed it is called no more: this and later calls give bus_error, and the text its value.
 * Errors: those of FIL-8; bus_error; out_of_memory also for want of `size` bytes of addresses. */
HMLFC_C_EXPORT int hmlfc_open_source(const hmlfc_source* source, const hmlfc_open_options* options,
                                     hmlfc_decoder** decoder, hmlfc_failure* failure);

/** Ends the use of `decoder`; null is allowed. Renderers on it work on. */
HMLFC_C_EXPORT void hmlfc_close(hmlfc_decoder* decoder);

/** The header of a stream under the specification's names (FIL-1). */
typedef struct hmlfc_header {
  size_t struct_size;     /**< sizeof(hmlfc_header); the one member that you set */
  uint32_t rows;          /**< of views, [1, 4096] */
  uint32_t cols;          /**< of views, [1, 4096] */
  uint32_t width;         /**< of a view, [1, 65536] pixels */
  uint32_t height;        /**< of a view, [1, 65536] pixels */
  uint32_t depth;         /**< bits a sample, [8, 12] */
  uint32_t chroma_format; /**< 0: 4:2:0, 1: 4:4:4 */
  uint32_t block_size;    /**< samples along the side of a block: 2, 4 or 8 */
  uint32_t tree_height;   /**< levels above the views, [0, 15] */
  uint32_t profile;       /**< 0: main, 1: extended */
  uint32_t feature_flags; /**< of profile extended (EXT-1) */
} hmlfc_header;

/** Fills in *header. */
HMLFC_C_EXPORT int hmlfc_get_header(const hmlfc_decoder* decoder, hmlfc_header* header,
                                    hmlfc_failure* failure);

/** One block of a plane of a view. */
typedef struct hmlfc_block {
  size_t struct_size;  /**< sizeof(hmlfc_block) */
  uint32_t row;        /**< of the view, [0, rows - 1] */
  uint32_t col;        /**< of the view, [0, cols - 1] */
  uint32_t plane;      /**< 0 Y, 1 Co, 2 Cg */
  uint32_t block_x;    /**< column of blocks, [0, ceil(plane width / block_size) - 1] */
  uint32_t block_y;    /**< row of blocks, [0, ceil(plane height / block_size) - 1] */
  uint32_t stop_level; /**< [0, tree_height]: 0 decodes the view, s its ancestor of level s */
} hmlfc_block;

/** Decodes a block to `samples`, which holds `count` values, block_size * block_size or more: row
 * by row; positions outside the plane have no meaning. Errors: those of annex A; bad_request. */
HMLFC_C_EXPORT int hmlfc_decode_block(const hmlfc_decoder* decoder, const hmlfc_block* block,
                                      int32_t* samples, size_t count, hmlfc_failure* failure);

/** A rectangle of pixels of a view. */
typedef struct hmlfc_rect {
  size_t struct_size;  /**< sizeof(hmlfc_rect) */
  uint32_t row;        /**< of the view, [0, rows - 1] */
  uint32_t col;        /**< of the view, [0, cols - 1] */
  uint32_t x;          /**< left column, [0, width of the view - 1] */
  uint32_t y;          /**< top row, [0, height of the view - 1] */
  uint32_t width;      /**< columns, [1, width of the view - x] */
  uint32_t height;     /**< rows, [1, height of the view - y] */
  uint32_t stop_level; /**< [0, tree_height] */
} hmlfc_rect;

/** Memory that receives pixels: samples R, G, B of each, row by row, in the machine's byte order.
 */
typedef struct hmlfc_pixels {
  size_t struct_size;    /**< sizeof(hmlfc_pixels) */
  void* data;            /**< the first row; aligned to sample_bytes */
  size_t bytes;          /**< at data, stride * (height - 1) + 3 * width * sample_bytes or more */
  size_t stride;         /**< bytes from row to row, a multiple of sample_bytes, 3 * width *
                              sample_bytes or more; 0: just that */
  uint32_t sample_bytes; /**< 1, at depth 8 alone, or 2 */
  uint32_t reserved;     /**< 0 */
} hmlfc_pixels;

/** Decodes a rectangle of a view, and no more than the blocks that it touches (COL-2, COL-3).
 * Bytes between rows are left as they are. Errors: those of annex A; bad_request. */
HMLFC_C_EXPORT int hmlfc_decode_rect(const hmlfc_decoder* decoder, const hmlfc_rect* rect,
                                     const hmlfc_pixels* pixels, hmlfc_failure* failure);

/** Decodes view (`row`, `col`) whole: hmlfc_decode_rect of all its pixels at stop level 0. */
HMLFC_C_EXPORT int hmlfc_decode_view(const hmlfc_decoder* decoder, uint32_t row, uint32_t col,
                                     const hmlfc_pixels* pixels, hmlfc_failure* failure);

/** What frames of one light field are rendered with; keeps decoded pixels between them. */
typedef struct hmlfc_renderer hmlfc_renderer;

/** How a renderer works; nothing here changes a frame. */
typedef struct hmlfc_render_options {
  size_t struct_size;   /**< sizeof(hmlfc_render_options) */
  uint64_t cache_bytes; /**< of decoded pixels kept between frames; 0: 2^28 */
  uint32_t threads;     /**< [0, 65535]; 0: all cores */
  uint32_t reserved;    /**< 0 */
} hmlfc_render_options;

/** Makes a renderer on `decoder`, which may be closed before it. `options` may be null. */
HMLFC_C_EXPORT int hmlfc_open_renderer(const hmlfc_decoder* decoder,
                                       const hmlfc_render_options* options,
                                       hmlfc_renderer** renderer, hmlfc_failure* failure);

/** Ends the use of `renderer`; null is allowed. */
HMLFC_C_EXPORT void hmlfc_close_renderer(hmlfc_renderer* renderer);

/** Which pixels of which views a pixel of a frame is the weighted mean of (SMP-1, SMP-2). */
typedef enum hmlfc_filter {
  HMLFC_FILTER_QUADRILINEAR = 0,
  HMLFC_FILTER_VIEWS = 1,
  HMLFC_FILTER_NEAREST = 2
} hmlfc_filter;

/** Where a frame takes the scene to be. */
typedef enum hmlfc_geometry {
  HMLFC_GEOMETRY_SUITABLE = 0, /**< stream, if it has shared disparities, else plane */
  HMLFC_GEOMETRY_PLANE = 1,    /**< in the focal plane */
  HMLFC_GEOMETRY_STREAM = 2    /**< where the disparity maps of the stream say */
} hmlfc_geometry;

/** A virtual camera (CAM-1 to CAM-3). With every member 0 but struct_size it stands in the middle
 * of the views and draws what a view shows. */
typedef struct hmlfc_camera {
  size_t struct_size;    /**< sizeof(hmlfc_camera) */
  uint32_t frame_width;  /**< [1, 4096] pixels; 0: that of a view */
  uint32_t frame_height; /**< [1, 4096] pixels; 0: that of a view */
  uint32_t has_position; /**< 1: it stands at position; 0: in the middle of the views */
  uint32_t has_look_at;  /**< 1: it looks at look_at; 0: straight ahead */
  double position[3];    /**< u, v, z: column and row of views, [-4096, 8192], and distance beyond
                              them in columns, [-4096, 4096] */
  double look_at[3];     /**< a point in the same units, [-2^20, 2^20] each */
  double focal;          /**< of the views, [1, 65536] pixels; 0: max(width, height) */
  double shear;          /**< disparity at infinity, [-256, 256] pixels a column */
  double row_pitch;      /**< distance of two rows in columns, +-[1/16, 127/16]; 0: the stream's */
  double tan_half;       /**< of half the field of view along the longer side, [2^-10, 2]; 0: the
                              largest frame that a view fills */
  double focus;          /**< disparity of the focal plane, [-256, 256] pixels a column */
  uint32_t aperture;     /**< log2 of the steps of views over which a weight falls to 0, [0, 3] */
  uint32_t filter;       /**< a hmlfc_filter */
  uint32_t geometry;     /**< a hmlfc_geometry */
  uint32_t stop_level;   /**< of the views, [0, tree_height] */
} hmlfc_camera;

/** Renders the frame of `camera` to `pixels`, of the light field's depth, as `hmlfc render` does.
 * Errors: bad_camera; those of NED-2. */
HMLFC_C_EXPORT int hmlfc_render(hmlfc_renderer* renderer, const hmlfc_camera* camera,
                                const hmlfc_pixels* pixels, hmlfc_failure* failure);

#ifdef __cplusplus
}
#endif

#endif
