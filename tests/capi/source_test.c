/* source_test STREAM: a stream whose bytes a function fetches decodes as from a file, by few bytes
 * and in one thread at a time; a function that fails is named and called no more. */
#define _POSIX_C_SOURCE 200112L

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "check.h"

enum { THREADS = 4, GONE = -7, OK = HMLFC_STATUS_OK, BUS = HMLFC_STATUS_BUS_ERROR };

static const struct timespec kLong = {0, 200000};

/* A file in memory that is handed out read by read. */
struct store {
  uint8_t* bytes;
  size_t size;
  size_t fetched;
  size_t calls;
  size_t failing; /* the number of the call that fails, from 0 */
  pthread_mutex_t alone;
};

static int fetch(void* user, const hmlfc_read* reads, size_t count) {
  struct store* store = user;
  uint64_t end = 0;
  CHECK(pthread_mutex_trylock(&store->alone) == 0); /* one thread at a time: */
  nanosleep(&kLong, NULL);                          /* long enough for another to come */
  if (store->calls++ == store->failing) return GONE;
  for (size_t i = 0; i < count; ++i) {
    CHECK(reads[i].size > 0 && (i == 0 || reads[i].offset > end));
    end = reads[i].offset + reads[i].size;
    CHECK(end <= store->size);
    memcpy(reads[i].data, store->bytes + reads[i].offset, reads[i].size);
    store->fetched += reads[i].size;
  }
  pthread_mutex_unlock(&store->alone);
  return 0;
}

static struct store stored(const char* path) {
  struct store store = {.failing = SIZE_MAX};
  FILE* file = fopen(path, "rb");
  CHECK(file != NULL && fseek(file, 0, SEEK_END) == 0);
  store.size = (size_t)ftell(file);
  store.bytes = malloc(store.size);
  rewind(file);
  CHECK(fread(store.bytes, 1, store.size, file) == store.size);
  fclose(file);
  pthread_mutex_init(&store.alone, NULL);
  return store;
}

static int open_store(struct store* store, uint32_t skip_sections, hmlfc_decoder** decoder,
                      hmlfc_failure* failure) {
  const hmlfc_source source = {sizeof source, store->size, fetch, store, 0};
  const hmlfc_open_options options = {.struct_size = sizeof options,
                                      .skip_sections = skip_sections};
  store->calls = 0;
  store->fetched = 0;
  pthread_mutex_destroy(&store->alone);
  pthread_mutex_init(&store->alone, NULL);
  return hmlfc_open_source(&source, &options, decoder, failure);
}

/* All views of `decoder`, one after the other. */
static unsigned char* views_of(const hmlfc_decoder* decoder) {
  const hmlfc_header header = header_of(decoder);
  const size_t view = (size_t)3 * header.width * header.height;
  unsigned char* views = malloc(view * header.rows * header.cols);
  hmlfc_pixels pixels = {.struct_size = sizeof pixels, .data = views, .bytes = view};
  pixels.sample_bytes = 1;
  for (uint32_t i = 0; i < header.rows * header.cols; ++i) {
    CHECK_STATUS(hmlfc_decode_view(decoder, i / header.cols, i % header.cols, &pixels, NULL), OK);
    pixels.data = (unsigned char*)pixels.data + view;
  }
  return views;
}

static void* decode(void* decoder) { return views_of(decoder); }

/* What four threads decode at once is what the file holds. */
static void check_equal(struct store* store, const hmlfc_decoder* file) {
  const hmlfc_header header = header_of(file);
  const size_t bytes = (size_t)3 * header.width * header.height * header.rows * header.cols;
  unsigned char* expected = views_of(file);
  hmlfc_decoder* decoder;
  pthread_t threads[THREADS];
  CHECK_STATUS(open_store(store, 1, &decoder, NULL), OK);
  for (int i = 0; i < THREADS; ++i) {
    CHECK(pthread_create(&threads[i], NULL, decode, decoder) == 0);
  }
  for (int i = 0; i < THREADS; ++i) {
    void* views;
    CHECK(pthread_join(threads[i], &views) == 0);
    CHECK(memcmp(views, expected, bytes) == 0);
    free(views);
  }
  CHECK(store->fetched < 2 * store->size); /* what is there is kept, for all */
  hmlfc_close(decoder);
  free(expected);
}

/* One block needs little of the stream; the sections' checks need all. */
static void check_amounts(struct store* store) {
  const hmlfc_block block = {.struct_size = sizeof block};
  hmlfc_decoder* decoder;
  int32_t samples[64];
  CHECK_STATUS(open_store(store, 1, &decoder, NULL), OK);
  CHECK(store->fetched < store->size / 2);
  CHECK_STATUS(hmlfc_decode_block(decoder, &block, samples, 64, NULL), OK);
  CHECK(store->fetched < store->size);
  hmlfc_close(decoder);
  CHECK_STATUS(open_store(store, 0, &decoder, NULL), OK);
  CHECK(store->fetched == store->size);
  hmlfc_close(decoder);
}

/* Whichever call fails: its value is told, and it stays the last. The decoder may be closed before
 * the renderer. */
static void check_failing(struct store* store) {
  const hmlfc_camera camera = {.struct_size = sizeof camera};
  hmlfc_failure failure = {.struct_size = sizeof failure};
  int status = BUS;
  for (store->failing = 0; status != OK; ++store->failing) {
    hmlfc_decoder* decoder = NULL;
    hmlfc_renderer* renderer = NULL;
    hmlfc_pixels pixels;
    status = open_store(store, 1, &decoder, &failure);
    if (status == OK) {
      pixels = allocated(header_of(decoder).width, header_of(decoder).height, 1);
      CHECK_STATUS(hmlfc_open_renderer(decoder, NULL, &renderer, NULL), OK);
      hmlfc_close(decoder);
      status = hmlfc_render(renderer, &camera, &pixels, &failure);
      CHECK_STATUS(hmlfc_render(renderer, &camera, &pixels, NULL), status);
      hmlfc_close_renderer(renderer);
      check_end(&pixels);
      free(pixels.data);
    } else {
      CHECK(decoder == NULL);
    }
    if (status == OK) break;
    CHECK_STATUS(status, BUS);
    CHECK(strcmp(failure.text, "bus_error: the function of the source returned -7") == 0);
    CHECK(store->calls == store->failing + 1);
  }
  CHECK(store->failing > 2);
}

int main(int count, char** arguments) {
  struct store store = stored(arguments[count - 1]);
  hmlfc_decoder* file = opened(arguments[1]);
  check_equal(&store, file);
  check_amounts(&store);
  check_failing(&store);
  hmlfc_close(file);
  free(store.bytes);
  return 0;
}
