/* arguments_test STREAM DEEP: wrong arguments of hmlfc.h that are no members of structures are
 * refused by their names, and failures are told. DEEP has more than 8 bits a sample. */
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { BAD = HMLFC_STATUS_BAD_ARGUMENT, OK = HMLFC_STATUS_OK };

static void check_statuses(void) {
  CHECK(strcmp(hmlfc_status_name(0), "ok") == 0);
  CHECK(strcmp(hmlfc_status_name(HMLFC_STATUS_VECTOR_RANGE), "vector_range") == 0);
  CHECK(strcmp(hmlfc_status_name(HMLFC_STATUS_BUS_ERROR), "bus_error") == 0);
  CHECK(strcmp(hmlfc_status_name(HMLFC_STATUS_INTERNAL), "internal") == 0);
  for (int unknown = 28; unknown < 64; ++unknown) {
    CHECK(strcmp(hmlfc_status_name(unknown), "unknown_status") == 0);
  }
  CHECK(strcmp(hmlfc_status_name(-1), "unknown_status") == 0);
  for (int status = 0; status < 70; ++status) CHECK(strlen(hmlfc_status_meaning(status)) > 5);
  CHECK(strlen(hmlfc_version()) >= 5);
}

static void check_failures(void) {
  hmlfc_decoder* decoder;
  hmlfc_failure small = {.struct_size = sizeof small - 1};
  hmlfc_failure failure = {.struct_size = sizeof failure};
  struct {
    hmlfc_failure known;
    char unknown[8];
  } newer = {{.struct_size = sizeof newer}, "abcdefg"};
  CHECK_STATUS(hmlfc_open_file("nowhere", NULL, &decoder, &small), BAD);
  CHECK_STATUS(hmlfc_open_file("nowhere", NULL, &decoder, &failure), HMLFC_STATUS_NO_FILE);
  CHECK(decoder == NULL && failure.status == HMLFC_STATUS_NO_FILE);
  CHECK(strstr(failure.text, "nowhere") != NULL && strstr(failure.text, "No such file") != NULL);
  CHECK_STATUS(hmlfc_open_file("/", NULL, &decoder, &failure), HMLFC_STATUS_NO_FILE);
  CHECK_STATUS(hmlfc_open_memory((const uint8_t*)"HMLG", 4, NULL, &decoder, &newer.known),
               HMLFC_STATUS_TRUNCATED);
  CHECK(newer.known.struct_size == sizeof newer && newer.known.offset == 4);
  for (size_t i = 0; i < sizeof newer.unknown; ++i) CHECK(newer.unknown[i] == 0);
  CHECK_STATUS(hmlfc_open_memory(NULL, 0, NULL, &decoder, &failure), HMLFC_STATUS_TRUNCATED);
  CHECK(strstr(failure.text, "truncated in header") == failure.text);
}

/* What no structure holds: pointers, paths, counts. */
static void check_others(const struct context* context) {
  hmlfc_decoder* decoder = (hmlfc_decoder*)1;
  hmlfc_renderer* renderer = (hmlfc_renderer*)1;
  const hmlfc_block block = {.struct_size = sizeof block};
  const hmlfc_camera camera = {.struct_size = sizeof camera};
  hmlfc_header header = header_of(context->decoder);
  int32_t samples[17];
  samples[16] = 1234567;
  CHECK_STATUS(hmlfc_open_memory(NULL, 1, NULL, &decoder, NULL), BAD);
  CHECK(decoder == NULL);
  CHECK_STATUS(hmlfc_open_memory((const uint8_t*)"", 0, NULL, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_open_file(NULL, NULL, &decoder, NULL), BAD);
  CHECK_STATUS(hmlfc_open_file(context->path, NULL, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_get_header(NULL, &header, NULL), BAD);
  CHECK_STATUS(hmlfc_get_header(context->decoder, NULL, NULL), BAD);
  header.struct_size = offsetof(hmlfc_header, feature_flags);
  CHECK_STATUS(hmlfc_get_header(context->decoder, &header, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(context->decoder, &block, samples, 16, NULL), OK);
  CHECK(samples[16] == 1234567);
  CHECK_STATUS(hmlfc_decode_block(NULL, &block, samples, 16, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(context->decoder, &block, NULL, 16, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(context->decoder, &block, samples, 15, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_rect(NULL, &context->rect, &context->pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_view(NULL, 0, 0, &context->pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_view(context->decoder, 0, 0, NULL, NULL), BAD);
  header = header_of(context->decoder);
  CHECK_STATUS(hmlfc_decode_view(context->decoder, header.rows, 0, &context->pixels, NULL),
               HMLFC_STATUS_BAD_REQUEST);
  CHECK_STATUS(hmlfc_open_renderer(NULL, NULL, &renderer, NULL), BAD);
  CHECK(renderer == NULL);
  CHECK_STATUS(hmlfc_open_renderer(context->decoder, NULL, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_render(NULL, &camera, &context->pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_render(context->renderer, &camera, NULL, NULL), BAD);
  hmlfc_close(NULL);
  hmlfc_close_renderer(NULL);
}

/* Texts name what is wrong, and are cut to what a failure holds. */
static void check_texts(const struct context* context, const hmlfc_decoder* deep) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_camera camera = {.struct_size = sizeof camera, .aperture = UINT32_MAX};
  hmlfc_pixels pixels = context->pixels;
  hmlfc_decoder* decoder;
  char long_path[4096];
  pixels.bytes -= 1;
  CHECK_STATUS(hmlfc_decode_view(context->decoder, 0, 0, &pixels, &failure), BAD);
  CHECK(strcmp(failure.text, "pixels has too few bytes for the pixels") == 0);
  CHECK_STATUS(hmlfc_render(context->renderer, &camera, &context->pixels, &failure),
               HMLFC_STATUS_BAD_CAMERA);
  CHECK(strstr(failure.text, "aperture") != NULL);
  memset(long_path, 'x', sizeof long_path);
  long_path[sizeof long_path - 1] = '\0';
  CHECK_STATUS(hmlfc_open_file(long_path, NULL, &decoder, &failure), HMLFC_STATUS_NO_FILE);
  CHECK(strlen(failure.text) == HMLFC_FAILURE_TEXT - 1);
  CHECK(header_of(deep).depth > 8);
  pixels = context->pixels;
  pixels.sample_bytes = 1;
  CHECK_STATUS(hmlfc_decode_view(deep, 0, 0, &pixels, &failure), BAD);
  CHECK(strcmp(failure.text, "pixels needs sample_bytes 2 above 8 bits") == 0);
}

static void check_stride(const hmlfc_decoder* decoder) {
  const hmlfc_header header = header_of(decoder);
  const hmlfc_rect part = {sizeof part, 1, 0, 3, 2, 5, 4, 0};
  hmlfc_pixels whole = allocated(header.width, header.height, 2);
  hmlfc_pixels some = allocated(10, 4, 1);
  const uint16_t* all = whole.data;
  const unsigned char* bytes = some.data;
  CHECK_STATUS(hmlfc_decode_view(decoder, 1, 0, &whole, NULL), OK);
  some.stride = 27;
  CHECK_STATUS(hmlfc_decode_rect(decoder, &part, &some, NULL), OK);
  for (uint32_t y = 0; y < 4; ++y) {
    for (uint32_t x = 0; x < 27; ++x) {
      const uint16_t sample = all[3 * ((y + 2) * header.width + 3) + x];
      CHECK(bytes[27 * y + x] == (x < 15 ? sample : 0xaa));
    }
  }
  CHECK(bytes[4 * 27] == 0xaa);
  free(whole.data);
  free(some.data);
}

int main(int count, char** arguments) {
  hmlfc_decoder* deep = opened(arguments[count - 1]);
  hmlfc_decoder* decoder = opened(arguments[1]);
  const hmlfc_header header = header_of(decoder);
  struct context context = {.path = arguments[1], .decoder = decoder};
  context.pixels = allocated(header.width, header.height, 2);
  context.rect = (hmlfc_rect){sizeof context.rect, 0, 0, 0, 0, header.width, header.height, 0};
  CHECK_STATUS(hmlfc_open_renderer(decoder, NULL, &context.renderer, NULL), OK);
  check_statuses();
  check_failures();
  check_others(&context);
  check_texts(&context, deep);
  check_stride(decoder);
  check_end(&context.pixels);
  free(context.pixels.data);
  hmlfc_close_renderer(context.renderer);
  hmlfc_close(decoder);
  hmlfc_close(deep);
  return 0;
}
