/* What the C99 tests of hmlfc.h share. */
#ifndef HMLFC_TESTS_CAPI_CHECK_H
#define HMLFC_TESTS_CAPI_CHECK_H

#include <hmlfc/hmlfc.h>

/* Says where `condition` does not hold, and ends the program with status 1. */
#define CHECK(condition) check((condition) != 0, #condition, __FILE__, __LINE__)

/* The status of `call` by its name. */
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)

void check(int holds, const char* condition, const char* file, int line);
void check_status(int status, int expected, const char* call, const char* file, int line);

/* Arguments that are good; what is under test takes the place of one of them. */
struct context {
  const char* path;
  const hmlfc_decoder* decoder;
  hmlfc_renderer* renderer;
  hmlfc_pixels pixels;
  hmlfc_rect rect;
};

/* The stream in `path`, opened. */
hmlfc_decoder* opened(const char* path);

/* The header of `decoder`. */
hmlfc_header header_of(const hmlfc_decoder* decoder);

/* Memory for width x height pixels of sample_bytes each, filled with 0xaa; ends in a byte 0x55 that
 * check_end() looks for. */
hmlfc_pixels allocated(uint32_t width, uint32_t height, uint32_t sample_bytes);
void check_end(const hmlfc_pixels* pixels);

#endif
