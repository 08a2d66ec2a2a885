#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check(int holds, const char* condition, const char* file, int line) {
  if (holds) return;
  fprintf(stderr, "%s:%d: %s does not hold\n", file, line, condition);
  exit(1);
}

void check_status(int status, int expected, const char* call, const char* file, int line) {
  if (status == expected) return;
  fprintf(stderr, "%s:%d: %s gives %s, not %s\n", file, line, call, hmlfc_status_name(status),
          hmlfc_status_name(expected));
  exit(1);
}

hmlfc_decoder* opened(const char* path) {
  hmlfc_decoder* decoder;
  CHECK_STATUS(hmlfc_open_file(path, NULL, &decoder, NULL), HMLFC_STATUS_OK);
  return decoder;
}

hmlfc_header header_of(const hmlfc_decoder* decoder) {
  hmlfc_header header = {.struct_size = sizeof header};
  CHECK_STATUS(hmlfc_get_header(decoder, &header, NULL), HMLFC_STATUS_OK);
  return header;
}

hmlfc_pixels allocated(uint32_t width, uint32_t height, uint32_t sample_bytes) {
  hmlfc_pixels pixels = {.struct_size = sizeof pixels};
  pixels.bytes = (size_t)3 * width * height * sample_bytes;
  pixels.data = malloc(pixels.bytes + 1);
  pixels.sample_bytes = sample_bytes;
  CHECK(pixels.data != NULL);
  memset(pixels.data, 0xaa, pixels.bytes);
  ((unsigned char*)pixels.data)[pixels.bytes] = 0x55;
  return pixels;
}

void check_end(const hmlfc_pixels* pixels) {
  CHECK(((const unsigned char*)pixels->data)[pixels->bytes] == 0x55);
}
