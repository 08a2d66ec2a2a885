/** @file
 * A decoder as a shared library that `hmlfc conform` can test: plain C99.
 *
 * Implement the functions below, build a shared library, and run
 *   hmlfc conform --dut ./libmydec.so -o report
 * The library is loaded in a process of its own, by one thread, for one stream after the other. A
 * crash or a hang is a result of the test, not its end. docs/conformance.md leads through it.
 *
 * Statuses are the numbers of annex A of the specification: 0 for success, else the first error.
 * A function that fails leaves its outputs without meaning. */
#ifndef HMLFC_DUT_H
#define HMLFC_DUT_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define HMLFC_DUT_EXPORT __declspec(dllexport)
#else
#define HMLFC_DUT_EXPORT __attribute__((visibility("default")))
#endif

/** The version of this interface. It changes only when an older library would be misread. */
#define HMLFC_DUT_ABI 1

/** Instead of a status, from hmlfc_dut_open: the decoder cannot run on this machine (no device, no
 * licence). The vector is then skipped, which is no pass. */
#define HMLFC_DUT_CANNOT_RUN (-1)

/** Samples of the largest block: 8 x 8. */
#define HMLFC_DUT_BLOCK_SAMPLES 64

#ifdef __cplusplus
extern "C" {
#endif

/** An open stream; only the library knows what is in it. */
typedef struct hmlfc_dut hmlfc_dut;

/** Header fields (FIL-1) under the specification's names. */
typedef struct hmlfc_dut_geometry {
  uint32_t rows;          /**< view rows, [1, 4096] */
  uint32_t cols;          /**< view columns, [1, 4096] */
  uint32_t width;         /**< pixels, [1, 65536] */
  uint32_t height;        /**< pixels, [1, 65536] */
  uint32_t depth;         /**< bits a sample, [8, 12] */
  uint32_t chroma_format; /**< 0: 4:2:0, 1: 4:4:4 */
  uint32_t block_log2;    /**< [1, 3] */
  uint32_t tree_height;   /**< [0, 15] */
} hmlfc_dut_geometry;

/** One block of one image of the tree, and the values of one stage of it (row by row, B * B of
 * them). `stage` is "parent", "reference", "prediction", "residual" or "sample", as `hmlfc inspect`
 * names them. */
typedef struct hmlfc_dut_stage {
  const char* stage;     /**< its name */
  uint32_t level;        /**< [0, tree_height] */
  uint32_t image_row;    /**< in the level's grid of images */
  uint32_t image_col;    /**< in the level's grid of images */
  uint32_t plane;        /**< 0 Y, 1 Co, 2 Cg */
  uint32_t block_x;      /**< column of blocks */
  uint32_t block_y;      /**< row of blocks */
  uint32_t count;        /**< of values, B * B */
  const int32_t* values; /**< row by row */
} hmlfc_dut_stage;

/** Numbers of a frame record (REC-2). */
#define HMLFC_DUT_RECORD_NUMBERS 41

/** A camera: the inputs of CAM-3 under their names. NAN stands for the default; pu, pv and pz are
 * all given or none of them, qu, qv and qz likewise. */
typedef struct hmlfc_dut_camera {
  double frame_width;  /**< pixels */
  double frame_height; /**< pixels */
  double focal;        /**< focal length of the views, pixels */
  double shear;        /**< disparity at infinity, pixels a column */
  double row_pitch;    /**< distance of two rows, in columns */
  double pu;           /**< position: column */
  double pv;           /**< position: row */
  double pz;           /**< position: distance beyond the view plane, in columns */
  double qu;           /**< look_at: column */
  double qv;           /**< look_at: row */
  double qz;           /**< look_at: distance beyond the view plane, in columns */
  double tan_half;     /**< tangent of half the field of view along the longer side */
  double focus;        /**< disparity of the focal plane, pixels a column */
  double aperture;     /**< log2 of the steps over which a view's weight falls to 0 */
  double filter;       /**< 0 nearest, 1 views, 2 quadrilinear */
  double geometry;     /**< 0 plane, 1 stream */
} hmlfc_dut_camera;

/** What a frame took. A renderer that does not count leaves what it gets, -1. */
typedef struct hmlfc_dut_counts {
  int64_t pixels_outside;        /**< RAY-6 */
  int64_t blocks_needed;         /**< NED-1 */
  int64_t disparities_looked_up; /**< SRF-5 */
} hmlfc_dut_counts;

/** A number that a renderer computes for a pixel of a frame, with the names of
 * `hmlfc render --trace`, such as "view" and "fx". */
typedef struct hmlfc_dut_number {
  const char* stage; /**< "cell ray", "proposal", "cell", "ray", "view" or "sum" */
  int32_t view_row;  /**< of a "proposal" or "view", else -1 */
  int32_t view_col;  /**< the same */
  const char* name;  /**< in rendering.md */
  int64_t value;     /**< in the unit of its clause */
} hmlfc_dut_number;

/** Receives each number; `context` is what the caller of hmlfc_dut_trace_pixel gave. */
typedef void (*hmlfc_dut_number_sink)(void* context, const hmlfc_dut_number* number);

/** Receives each stage; `context` is what the caller of hmlfc_dut_trace_block gave. */
typedef void (*hmlfc_dut_stage_sink)(void* context, const hmlfc_dut_stage* stage);

/** Returns HMLFC_DUT_ABI as the library was compiled with. */
HMLFC_DUT_EXPORT uint32_t hmlfc_dut_abi(void);

/** The decoder's name and version, for reports; a string that lives as long as the library. */
HMLFC_DUT_EXPORT const char* hmlfc_dut_name(void);

/** Opens the stream of `size` bytes at `bytes`, which live until hmlfc_dut_close. On success *dut
 * is the stream, on failure null. */
HMLFC_DUT_EXPORT int hmlfc_dut_open(const uint8_t* bytes, size_t size, hmlfc_dut** dut);

/** Fills in *geometry. Returns 0. */
HMLFC_DUT_EXPORT int hmlfc_dut_get_geometry(const hmlfc_dut* dut, hmlfc_dut_geometry* geometry);

/** Decodes view (row, col) to height rows of width pixels R, G, B, row by row, in
 * [0, 2^depth - 1] each. */
HMLFC_DUT_EXPORT int hmlfc_dut_decode_view(hmlfc_dut* dut, uint32_t row, uint32_t col,
                                           uint16_t* rgb);

/** Decodes one block of a plane (0 Y, 1 Co, 2 Cg) of view (row, col) at stop level s of DEC-1:
 * B * B samples row by row; those outside the plane have no meaning. */
HMLFC_DUT_EXPORT int hmlfc_dut_decode_block(hmlfc_dut* dut, uint32_t row, uint32_t col,
                                            uint32_t plane, uint32_t block_x, uint32_t block_y,
                                            uint32_t stop_level, int32_t* samples);

/** Optional: decodes one block at stop level 0 and reports its stages from the top level down, in
 * the order in which they are made. With it, reports name the first wrong stage. */
HMLFC_DUT_EXPORT int hmlfc_dut_trace_block(hmlfc_dut* dut, uint32_t row, uint32_t col,
                                           uint32_t plane, uint32_t block_x, uint32_t block_y,
                                           hmlfc_dut_stage_sink sink, void* context);

/** Optional: makes the frame record of a camera (REC-2). Returns 0, or 1 with *input, the name in
 * CAM-3 of the input that is refused, such as "look_at". */
HMLFC_DUT_EXPORT int hmlfc_dut_frame_record(const hmlfc_dut* dut, const hmlfc_dut_camera* camera,
                                            int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                                            const char** input);

/** Optional: draws the frame of a record from views decoded down to `stop_level`: frame_height rows
 * of frame_width pixels R, G, B. */
HMLFC_DUT_EXPORT int hmlfc_dut_render_frame(hmlfc_dut* dut,
                                            const int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                                            uint32_t stop_level, uint16_t* rgb,
                                            hmlfc_dut_counts* counts);

/** Optional: reports what is computed for pixel (x, y) of a frame, as far as it is known, in the
 * order in which it is computed. With it, reports name the first wrong number. */
HMLFC_DUT_EXPORT int hmlfc_dut_trace_pixel(hmlfc_dut* dut,
                                           const int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                                           uint32_t stop_level, uint32_t x, uint32_t y,
                                           hmlfc_dut_number_sink sink, void* context);

/** Optional: the disparity map of view (row, col): for each block of plane Y, row by row, its
 * disparity and confidence (GEO-1). */
HMLFC_DUT_EXPORT int hmlfc_dut_disparity_map(hmlfc_dut* dut, uint32_t row, uint32_t col,
                                             int16_t* disparities, uint8_t* confidences);

/** Optional: the name of annex A for a status, such as "bad_levels"; the numbers of annex A are
 * used without it. */
HMLFC_DUT_EXPORT const char* hmlfc_dut_error_name(int status);

/** Ends the use of `dut`; null is allowed. */
HMLFC_DUT_EXPORT void hmlfc_dut_close(hmlfc_dut* dut);

#ifdef __cplusplus
}
#endif

#endif
