/* Decodes by hmlfc.h what vectors_test.py asks for, one request a line:
 *   views FILE                              -> "ok BYTES" and the raw form of all views, or a
 * failure block ROW COL PLANE BX BY FILE          -> "ok", or a failure A failure is "NAME OFFSET".
 */
#include <hmlfc/hmlfc.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_failure(int status, const hmlfc_failure* failure) {
  printf("%s %" PRIu64 "\n", hmlfc_status_name(status), failure->offset);
}

/* The raw form: the least bytes a sample, the lower byte first. */
static int decode_views(const hmlfc_decoder* decoder, hmlfc_failure* failure) {
  hmlfc_header header = {.struct_size = sizeof header};
  int status = hmlfc_get_header(decoder, &header, failure);
  const size_t samples = (size_t)3 * header.width * header.height;
  const size_t sample_bytes = header.depth > 8 ? 2 : 1;
  const size_t view_bytes = samples * sample_bytes;
  const size_t views = (size_t)header.rows * header.cols;
  unsigned char* raw;
  if (status != HMLFC_STATUS_OK) return status;
  raw = malloc(view_bytes * views);
  if (raw == NULL) return HMLFC_STATUS_OUT_OF_MEMORY;
  for (size_t i = 0; i < views && status == HMLFC_STATUS_OK; ++i) {
    hmlfc_pixels pixels = {.struct_size = sizeof pixels};
    pixels.data = raw + i * view_bytes;
    pixels.bytes = view_bytes;
    pixels.sample_bytes = (uint32_t)sample_bytes;
    status = hmlfc_decode_view(decoder, (uint32_t)(i / header.cols), (uint32_t)(i % header.cols),
                               &pixels, failure);
  }
  if (status == HMLFC_STATUS_OK) {
    printf("ok %zu\n", view_bytes * views);
    fwrite(raw, 1, view_bytes * views, stdout);
  }
  free(raw);
  return status;
}

static int decode_block(const hmlfc_decoder* decoder, char* request, hmlfc_failure* failure) {
  int32_t samples[64];
  hmlfc_block block = {.struct_size = sizeof block};
  int status;
  block.row = (uint32_t)strtoul(request, &request, 10);
  block.col = (uint32_t)strtoul(request, &request, 10);
  block.plane = (uint32_t)strtoul(request, &request, 10);
  block.block_x = (uint32_t)strtoul(request, &request, 10);
  block.block_y = (uint32_t)strtoul(request, &request, 10);
  status = hmlfc_decode_block(decoder, &block, samples, 64, failure);
  if (status == HMLFC_STATUS_OK) puts("ok");
  return status;
}

int main(void) {
  char line[4096];
  while (fgets(line, sizeof line, stdin) != NULL) {
    hmlfc_failure failure = {.struct_size = sizeof failure};
    hmlfc_decoder* decoder;
    char* path = strrchr(line, ' ');
    int status;
    line[strcspn(line, "\n")] = '\0';
    if (path == NULL) return 2;
    status = hmlfc_open_file(path + 1, NULL, &decoder, &failure);
    if (status == HMLFC_STATUS_OK) {
      status = strncmp(line, "block ", 6) == 0 ? decode_block(decoder, line + 6, &failure)
                                               : decode_views(decoder, &failure);
    }
    if (status != HMLFC_STATUS_OK) print_failure(status, &failure);
    hmlfc_close(decoder);
    fflush(stdout);
  }
  return 0;
}
