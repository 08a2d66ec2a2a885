/* arguments_test STREAM DEEP: every wrong argument of hmlfc.h is refused by its name, structures of
 * older and newer callers are understood. DEEP has more than 8 bits a sample. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { BAD = HMLFC_STATUS_BAD_ARGUMENT, OK = HMLFC_STATUS_OK };

/* What a caller of a later version may have compiled. */
struct newer_rect {
  hmlfc_rect known;
  uint64_t unknown;
};

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

static void check_opening(const char* path) {
  hmlfc_decoder* decoder = (hmlfc_decoder*)1;
  hmlfc_open_options options = {.struct_size = sizeof options};
  char long_path[4096];
  hmlfc_failure failure = {.struct_size = sizeof failure};
  CHECK_STATUS(hmlfc_open_memory(NULL, 1, NULL, &decoder, NULL), BAD);
  CHECK(decoder == NULL);
  CHECK_STATUS(hmlfc_open_memory((const uint8_t*)"", 0, NULL, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_open_file(NULL, NULL, &decoder, NULL), BAD);
  CHECK_STATUS(hmlfc_open_file(path, NULL, NULL, NULL), BAD);
  options.struct_size = 0;
  CHECK_STATUS(hmlfc_open_file(path, &options, &decoder, NULL), BAD);
  options.struct_size = sizeof options;
  options.skip_sections = 2;
  CHECK_STATUS(hmlfc_open_file(path, &options, &decoder, NULL), BAD);
  options.skip_sections = 1;
  options.reserved = 1;
  CHECK_STATUS(hmlfc_open_file(path, &options, &decoder, NULL), BAD);
  options.reserved = 0;
  options.max_plane_samples = 1;
  CHECK_STATUS(hmlfc_open_file(path, &options, &decoder, NULL), HMLFC_STATUS_LIMIT_EXCEEDED);
  options.max_plane_samples = 0;
  CHECK_STATUS(hmlfc_open_file(path, &options, &decoder, NULL), OK);
  hmlfc_close(decoder);
  hmlfc_close(NULL);
  memset(long_path, 'x', sizeof long_path);
  long_path[sizeof long_path - 1] = '\0';
  CHECK_STATUS(hmlfc_open_file(long_path, NULL, &decoder, &failure), HMLFC_STATUS_NO_FILE);
  CHECK(strlen(failure.text) == HMLFC_FAILURE_TEXT - 1);
}

static void check_header(const hmlfc_decoder* decoder) {
  hmlfc_header header = {.struct_size = sizeof header};
  CHECK_STATUS(hmlfc_get_header(NULL, &header, NULL), BAD);
  CHECK_STATUS(hmlfc_get_header(decoder, NULL, NULL), BAD);
  header.struct_size = offsetof(hmlfc_header, feature_flags);
  CHECK_STATUS(hmlfc_get_header(decoder, &header, NULL), BAD);
  header = header_of(decoder);
  CHECK(header.rows > 1 && header.width > 1 && header.depth == 8 && header.block_size == 4);
}

static void check_blocks(const hmlfc_decoder* decoder) {
  const hmlfc_block good = {sizeof good, 0, 0, 0, 0, 0, 0};
  const hmlfc_header header = header_of(decoder);
  int32_t samples[65];
  uint32_t* members;
  hmlfc_block block = good;
  samples[16] = 1234567;
  CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 16, NULL), OK);
  CHECK(samples[16] == 1234567);
  CHECK_STATUS(hmlfc_decode_block(NULL, &block, samples, 16, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(decoder, NULL, samples, 16, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(decoder, &block, NULL, 16, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 15, NULL), BAD);
  block.struct_size = offsetof(hmlfc_block, stop_level);
  CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 16, NULL), BAD);
  /* Each number too large, by one or by all there are. */
  for (int i = 0; i < 6; ++i) {
    const uint32_t first_outside[] = {
        header.rows,           header.cols, 3, (header.width + 3) / 4, (header.height + 3) / 4,
        header.tree_height + 1};
    block = good;
    members = &block.row;
    members[i] = first_outside[i];
    CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 16, NULL), HMLFC_STATUS_BAD_REQUEST);
    members[i] = UINT32_MAX;
    CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 16, NULL), HMLFC_STATUS_BAD_REQUEST);
  }
}

static void check_rects(const hmlfc_decoder* decoder) {
  const hmlfc_header header = header_of(decoder);
  const hmlfc_rect good = {sizeof good, 0, 0, 0, 0, header.width, header.height, 0};
  hmlfc_pixels pixels = allocated(header.width, header.height, 1);
  struct newer_rect newer;
  CHECK_STATUS(hmlfc_decode_rect(NULL, &good, &pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_rect(decoder, NULL, &pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_rect(decoder, &good, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_view(NULL, 0, 0, &pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_decode_view(decoder, header.rows, 0, &pixels, NULL), HMLFC_STATUS_BAD_REQUEST);
  for (int i = 0; i < 7; ++i) {
    const uint32_t outside[][2] = {{header.rows, UINT32_MAX},
                                   {header.cols, UINT32_MAX},
                                   {1, UINT32_MAX},
                                   {1, UINT32_MAX},
                                   {0, header.width + 1},
                                   {0, header.height + 1},
                                   {header.tree_height + 1, UINT32_MAX}};
    for (int k = 0; k < 2; ++k) {
      hmlfc_rect rect = good;
      (&rect.row)[i] = outside[i][k];
      CHECK_STATUS(hmlfc_decode_rect(decoder, &rect, &pixels, NULL), HMLFC_STATUS_BAD_REQUEST);
    }
  }
  memset(&newer, 0, sizeof newer);
  newer.known = good;
  newer.known.struct_size = sizeof newer;
  CHECK_STATUS(hmlfc_decode_rect(decoder, &newer.known, &pixels, NULL), OK);
  newer.unknown = (uint64_t)1 << 56;
  CHECK_STATUS(hmlfc_decode_rect(decoder, &newer.known, &pixels, NULL), BAD);
  check_end(&pixels);
  free(pixels.data);
}

/* A part of a view lands where stride says, and nothing else is written. */
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

static void check_pixels(const hmlfc_decoder* decoder, const hmlfc_decoder* deep) {
  const hmlfc_header header = header_of(decoder);
  const hmlfc_pixels good = allocated(header.width, header.height, 2);
  const size_t row = (size_t)6 * header.width;
  hmlfc_pixels pixels = good;
  hmlfc_failure failure = {.struct_size = sizeof failure};
  pixels.bytes -= 1;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, &failure), BAD);
  CHECK(strcmp(failure.text, "pixels has too few bytes for the pixels") == 0);
  pixels.bytes = 0;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels = good;
  pixels.stride = row - 2;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels.stride = row + 2; /* does not fit */
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels.stride = SIZE_MAX - 1;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels.stride = row + 1; /* not aligned, even with room */
  pixels.bytes = SIZE_MAX;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels = good;
  pixels.data = (char*)pixels.data + 1;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels.data = NULL;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels = good;
  pixels.reserved = 1;
  CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL), BAD);
  pixels = good;
  for (uint32_t bytes = 0; bytes < 5; ++bytes) {
    pixels.sample_bytes = bytes;
    CHECK_STATUS(hmlfc_decode_view(decoder, 0, 0, &pixels, NULL),
                 bytes == 1 || bytes == 2 ? OK : BAD);
  }
  pixels.sample_bytes = 1;
  CHECK(header_of(deep).depth > 8);
  CHECK_STATUS(hmlfc_decode_view(deep, 0, 0, &pixels, NULL), BAD);
  check_end(&good);
  free(good.data);
}

static void check_rendering(hmlfc_decoder* decoder) {
  const hmlfc_camera good = {.struct_size = sizeof good};
  const hmlfc_header header = header_of(decoder);
  hmlfc_render_options options = {.struct_size = sizeof options};
  hmlfc_pixels pixels = allocated(header.width, header.height, 1);
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_renderer* renderer = (hmlfc_renderer*)1;
  hmlfc_camera camera = good;
  CHECK_STATUS(hmlfc_open_renderer(NULL, NULL, &renderer, NULL), BAD);
  CHECK(renderer == NULL);
  CHECK_STATUS(hmlfc_open_renderer(decoder, NULL, NULL, NULL), BAD);
  options.threads = 65536;
  CHECK_STATUS(hmlfc_open_renderer(decoder, &options, &renderer, NULL), BAD);
  options.threads = 1;
  options.cache_bytes = 1;
  options.reserved = 1;
  CHECK_STATUS(hmlfc_open_renderer(decoder, &options, &renderer, NULL), BAD);
  options.reserved = 0;
  CHECK_STATUS(hmlfc_open_renderer(decoder, &options, &renderer, NULL), OK);
  hmlfc_close(decoder); /* the renderer goes on */
  CHECK_STATUS(hmlfc_render(NULL, &camera, &pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_render(renderer, NULL, &pixels, NULL), BAD);
  CHECK_STATUS(hmlfc_render(renderer, &camera, NULL, NULL), BAD);
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), OK);
  camera.aperture = UINT32_MAX;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, &failure), HMLFC_STATUS_BAD_CAMERA);
  CHECK(strstr(failure.text, "aperture") != NULL);
  camera = good;
  camera.focus = 257;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), HMLFC_STATUS_BAD_CAMERA);
  camera = good;
  camera.frame_width = 4097;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), HMLFC_STATUS_BAD_CAMERA);
  camera.frame_width = header.width + 1;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), BAD);
  camera = good;
  camera.filter = 3;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), BAD);
  camera = good;
  camera.geometry = 3;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), BAD);
  camera = good;
  camera.has_position = 2;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), BAD);
  camera = good;
  camera.has_look_at = 2;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), BAD);
  camera = good;
  camera.stop_level = header.tree_height + 1;
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), HMLFC_STATUS_BAD_REQUEST);
  check_end(&pixels);
  free(pixels.data);
  hmlfc_close_renderer(renderer);
  hmlfc_close_renderer(NULL);
}

int main(int count, char** arguments) {
  hmlfc_decoder* decoder;
  hmlfc_decoder* deep;
  CHECK(count == 3);
  check_statuses();
  check_failures();
  check_opening(arguments[1]);
  decoder = opened(arguments[1]);
  deep = opened(arguments[2]);
  check_header(decoder);
  check_blocks(decoder);
  check_rects(decoder);
  check_stride(decoder);
  check_pixels(decoder, deep);
  check_rendering(decoder);
  hmlfc_close(deep);
  return 0;
}
