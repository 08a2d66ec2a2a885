/* threads_test STREAM: four threads decode and render with one decoder at the same time; each gets
 * what one thread alone gets. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { THREADS = 4, ROUNDS = 3 };

struct work {
  const hmlfc_decoder* decoder;
  size_t frame_bytes;
  unsigned char* results; /* all views, then a frame */
};

static void decode(const struct work* work) {
  const hmlfc_header header = header_of(work->decoder);
  hmlfc_camera camera = {.struct_size = sizeof camera};
  hmlfc_pixels pixels = {.struct_size = sizeof pixels};
  hmlfc_renderer* renderer;
  pixels.bytes = work->frame_bytes;
  pixels.sample_bytes = 1;
  pixels.data = work->results;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      CHECK_STATUS(hmlfc_decode_view(work->decoder, row, col, &pixels, NULL), HMLFC_STATUS_OK);
      pixels.data = (unsigned char*)pixels.data + work->frame_bytes;
    }
  }
  camera.has_position = 1;
  camera.position[0] = 0.25;
  camera.position[1] = 0.5;
  CHECK_STATUS(hmlfc_open_renderer(work->decoder, NULL, &renderer, NULL), HMLFC_STATUS_OK);
  CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), HMLFC_STATUS_OK);
  hmlfc_close_renderer(renderer);
}

static void* run(void* argument) {
  decode(argument);
  return NULL;
}

int main(int count, char** arguments) {
  hmlfc_decoder* alone = opened(arguments[count - 1]);
  const hmlfc_header header = header_of(alone);
  const size_t frame = (size_t)3 * header.width * header.height;
  const size_t all = frame * ((size_t)header.rows * header.cols + 1);
  struct work expected;
  expected.decoder = alone;
  expected.frame_bytes = frame;
  expected.results = calloc(all, 1);
  decode(&expected);
  for (int round = 0; round < ROUNDS; ++round) {
    hmlfc_decoder* decoder = opened(arguments[1]);
    struct work works[THREADS];
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; ++i) {
      works[i] = expected;
      works[i].decoder = decoder;
      works[i].results = calloc(all, 1);
      CHECK(pthread_create(&threads[i], NULL, run, &works[i]) == 0);
    }
    for (int i = 0; i < THREADS; ++i) {
      CHECK(pthread_join(threads[i], NULL) == 0);
      CHECK(memcmp(works[i].results, expected.results, all) == 0);
      free(works[i].results);
    }
    hmlfc_close(decoder);
  }
  free(expected.results);
  hmlfc_close(alone);
  return 0;
}
