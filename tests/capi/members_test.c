/* members_test STREAM: every wrong member of a structure of hmlfc.h is refused, and structures of
 * older and newer callers are understood. */
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { BAD = HMLFC_STATUS_BAD_ARGUMENT, OK = HMLFC_STATUS_OK };
enum { REQUEST = HMLFC_STATUS_BAD_REQUEST, CAMERA = HMLFC_STATUS_BAD_CAMERA };

/* Calls a function with `structure` and all else good. */
typedef int (*call_function)(const struct context* context, const void* structure);

/* One member of a structure with another value, and what the call then gives. */
struct change {
  int line;
  size_t offset;
  size_t bytes; /* of the member */
  uint64_t value;
  int status;
};

/* A change in the form of a row: a member of bytes 4 or 8 that is not floating, or a double. */
#define SET(type, member, value, status) \
  { __LINE__, offsetof(type, member), sizeof(((type*)0)->member), (uint64_t)(value), status }
#define COUNT(rows) (sizeof(rows) / sizeof(rows)[0])

/* A structure with all members good, how it is called, and which changes are tried. */
struct kind {
  call_function call;
  const void* good;
  size_t bytes;       /* of the structure */
  size_t first_bytes; /* of its first version */
  int null_status;
  const struct change* changes;
  size_t change_count;
};

/* A copy of kind->good that says it has `size` bytes; those after the known ones are `beyond`. */
static void copy_as(const struct kind* kind, size_t size, int beyond, unsigned char* copy) {
  memset(copy, beyond, size);
  memcpy(copy, kind->good, size < kind->bytes ? size : kind->bytes);
  memcpy(copy, &size, sizeof size);
}

/* Callers of other versions: too small, as large as the first, larger with and without a value. */
static void check_versions(const struct context* context, const struct kind* kind) {
  enum { BEYOND = 8 };
  uint64_t room[40]; /* aligned for all */
  unsigned char* copy = (unsigned char*)room;
  CHECK(kind->bytes + BEYOND <= sizeof room);
  CHECK_STATUS(kind->call(context, NULL), kind->null_status);
  copy_as(kind, kind->first_bytes, 0, copy);
  CHECK_STATUS(kind->call(context, copy), OK);
  for (size_t small = 0; small < 2; ++small) {
    const size_t size = small * (kind->first_bytes - 1);
    memcpy(copy, &size, sizeof size);
    CHECK_STATUS(kind->call(context, copy), BAD);
  }
  copy_as(kind, kind->bytes + BEYOND, 0, copy);
  CHECK_STATUS(kind->call(context, copy), OK);
  for (size_t at = 0; at < BEYOND; ++at) {
    copy[kind->bytes + at] = 1;
    CHECK_STATUS(kind->call(context, copy), BAD);
    copy[kind->bytes + at] = 0;
  }
}

static void check_kind(const struct context* context, const struct kind* kind) {
  check_versions(context, kind);
  for (size_t i = 0; i < kind->change_count; ++i) {
    const struct change* change = &kind->changes[i];
    const uint32_t narrow = (uint32_t)change->value;
    uint64_t room[40];
    unsigned char* member = (unsigned char*)room + change->offset;
    copy_as(kind, kind->bytes, 0, (unsigned char*)room);
    memcpy(member, change->bytes == 4 ? (const void*)&narrow : &change->value, change->bytes);
    check_status(kind->call(context, room), change->status, "the call", __FILE__, change->line);
  }
}

/* The bits of a double, as a value of SET. */
static uint64_t bits_of(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static int open_with(const struct context* context, const void* options) {
  hmlfc_decoder* decoder = (hmlfc_decoder*)1;
  const int status = hmlfc_open_file(context->path, options, &decoder, NULL);
  CHECK((decoder == NULL) == (status != OK));
  hmlfc_close(decoder);
  return status;
}

static int block_with(const struct context* context, const void* block) {
  int32_t samples[16];
  return hmlfc_decode_block(context->decoder, block, samples, 16, NULL);
}

static int rect_with(const struct context* context, const void* rect) {
  return hmlfc_decode_rect(context->decoder, rect, &context->pixels, NULL);
}

static int pixels_with(const struct context* context, const void* pixels) {
  return hmlfc_decode_rect(context->decoder, &context->rect, pixels, NULL);
}

static int renderer_with(const struct context* context, const void* options) {
  hmlfc_renderer* renderer = (hmlfc_renderer*)1;
  const int status = hmlfc_open_renderer(context->decoder, options, &renderer, NULL);
  CHECK((renderer == NULL) == (status != OK));
  hmlfc_close_renderer(renderer);
  return status;
}

static int camera_with(const struct context* context, const void* camera) {
  return hmlfc_render(context->renderer, camera, &context->pixels, NULL);
}

static int no_bytes(void* user, const hmlfc_read* reads, size_t count) {
  CHECK(user == NULL && reads != NULL && count > 0);
  return 0; /* zeros, which are no stream */
}

static int source_with(const struct context* context, const void* source) {
  hmlfc_decoder* decoder = (hmlfc_decoder*)1;
  const int status = hmlfc_open_source(source, NULL, &decoder, NULL);
  CHECK(context != NULL && decoder == NULL);
  return status == HMLFC_STATUS_BAD_MAGIC ? OK : status;
}

static void check_options(const struct context* context) {
  const hmlfc_open_options good = {.struct_size = sizeof good};
  const struct change rows[] = {
      SET(hmlfc_open_options, skip_sections, 1, OK),
      SET(hmlfc_open_options, skip_sections, 2, BAD),
      SET(hmlfc_open_options, reserved, 1, BAD),
      SET(hmlfc_open_options, max_plane_samples, 1, HMLFC_STATUS_LIMIT_EXCEEDED),
      SET(hmlfc_open_options, max_code_blocks, 1, OK),
  };
  const struct kind kind = {
      open_with, &good, sizeof good, offsetof(hmlfc_open_options, max_code_blocks),
      OK,        rows,  COUNT(rows)};
  check_kind(context, &kind);
}

static void check_blocks(const struct context* context) {
  const hmlfc_header header = header_of(context->decoder);
  const hmlfc_block good = {.struct_size = sizeof good};
  const struct change rows[] = {
      SET(hmlfc_block, row, header.rows, REQUEST),
      SET(hmlfc_block, row, UINT32_MAX, REQUEST),
      SET(hmlfc_block, col, header.cols, REQUEST),
      SET(hmlfc_block, col, UINT32_MAX, REQUEST),
      SET(hmlfc_block, plane, 3, REQUEST),
      SET(hmlfc_block, plane, UINT32_MAX, REQUEST),
      SET(hmlfc_block, block_x, (header.width + 3) / 4, REQUEST),
      SET(hmlfc_block, block_x, UINT32_MAX, REQUEST),
      SET(hmlfc_block, block_y, (header.height + 3) / 4, REQUEST),
      SET(hmlfc_block, block_y, UINT32_MAX, REQUEST),
      SET(hmlfc_block, stop_level, header.tree_height + 1, REQUEST),
      SET(hmlfc_block, stop_level, UINT32_MAX, REQUEST),
  };
  const struct kind kind = {block_with, &good, sizeof good, offsetof(hmlfc_block, stop_level) + 4,
                            BAD,        rows,  COUNT(rows)};
  check_kind(context, &kind);
}

static void check_rects(const struct context* context) {
  const hmlfc_header header = header_of(context->decoder);
  const struct change rows[] = {
      SET(hmlfc_rect, row, header.rows, REQUEST),
      SET(hmlfc_rect, row, UINT32_MAX, REQUEST),
      SET(hmlfc_rect, col, header.cols, REQUEST),
      SET(hmlfc_rect, col, UINT32_MAX, REQUEST),
      SET(hmlfc_rect, x, 1, REQUEST),
      SET(hmlfc_rect, x, UINT32_MAX, REQUEST),
      SET(hmlfc_rect, y, 1, REQUEST),
      SET(hmlfc_rect, y, UINT32_MAX, REQUEST),
      SET(hmlfc_rect, width, 0, REQUEST),
      SET(hmlfc_rect, width, header.width + 1, REQUEST),
      SET(hmlfc_rect, height, 0, REQUEST),
      SET(hmlfc_rect, height, header.height + 1, REQUEST),
      SET(hmlfc_rect, stop_level, header.tree_height + 1, REQUEST),
      SET(hmlfc_rect, stop_level, UINT32_MAX, REQUEST),
  };
  const struct kind kind = {
      rect_with, &context->rect, sizeof context->rect, offsetof(hmlfc_rect, stop_level) + 4,
      BAD,       rows,           COUNT(rows)};
  check_kind(context, &kind);
}

static void check_pixels(const struct context* context) {
  const hmlfc_header header = header_of(context->decoder);
  const uint64_t row = (uint64_t)6 * header.width;
  const struct change rows[] = {
      SET(hmlfc_pixels, data, 0, BAD),
      SET(hmlfc_pixels, data, (uintptr_t)context->pixels.data + 1, BAD),
      SET(hmlfc_pixels, bytes, context->pixels.bytes - 1, BAD),
      SET(hmlfc_pixels, bytes, 0, BAD),
      SET(hmlfc_pixels, stride, row, OK),
      SET(hmlfc_pixels, stride, row - 2, BAD),
      SET(hmlfc_pixels, stride, row + 2, BAD), /* does not fit */
      SET(hmlfc_pixels, stride, SIZE_MAX - 1, BAD),
      SET(hmlfc_pixels, sample_bytes, 0, BAD),
      SET(hmlfc_pixels, sample_bytes, 1, OK),
      SET(hmlfc_pixels, sample_bytes, 3, BAD),
      SET(hmlfc_pixels, sample_bytes, 4, BAD),
      SET(hmlfc_pixels, reserved, 1, BAD),
  };
  const struct kind kind = {
      pixels_with, &context->pixels, sizeof context->pixels, sizeof context->pixels, BAD,
      rows,        COUNT(rows)};
  check_kind(context, &kind);
}

static void check_renderers(const struct context* context) {
  const hmlfc_render_options good = {.struct_size = sizeof good, .threads = 1};
  const struct change rows[] = {
      SET(hmlfc_render_options, threads, 65536, BAD),
      SET(hmlfc_render_options, cache_bytes, 1, OK),
      SET(hmlfc_render_options, reserved, 1, BAD),
  };
  const struct kind kind = {renderer_with, &good, sizeof good, sizeof good, OK, rows, COUNT(rows)};
  check_kind(context, &kind);
}

static void check_cameras(const struct context* context, hmlfc_header header) {
  const hmlfc_camera good = {.struct_size = sizeof good};
  const struct change rows[] = {
      SET(hmlfc_camera, aperture, UINT32_MAX, CAMERA),
      SET(hmlfc_camera, focus, bits_of(257), CAMERA),
      SET(hmlfc_camera, frame_width, 4097, CAMERA),
      SET(hmlfc_camera, frame_width, header.width + 1, BAD), /* more than the pixels */
      SET(hmlfc_camera, filter, 3, BAD),
      SET(hmlfc_camera, geometry, 3, BAD),
      SET(hmlfc_camera, has_position, 2, BAD),
      SET(hmlfc_camera, has_look_at, 2, BAD),
      SET(hmlfc_camera, stop_level, header.tree_height + 1, REQUEST),
  };
  const struct kind kind = {camera_with, &good, sizeof good, sizeof good, BAD, rows, COUNT(rows)};
  check_kind(context, &kind);
}

static void check_sources(const struct context* context) {
  const hmlfc_source good = {.struct_size = sizeof good, .size = 100, .read = no_bytes};
  const struct change rows[] = {
      SET(hmlfc_source, read, 0, BAD),
      SET(hmlfc_source, size, 0, HMLFC_STATUS_TRUNCATED),
      SET(hmlfc_source, size, UINT64_MAX, HMLFC_STATUS_OUT_OF_MEMORY),
      SET(hmlfc_source, cache_bytes, 1, OK),
  };
  const struct kind kind = {source_with, &good, sizeof good, sizeof good, BAD, rows, COUNT(rows)};
  check_kind(context, &kind);
}

int main(int count, char** arguments) {
  hmlfc_decoder* decoder = opened(arguments[count - 1]);
  const hmlfc_header header = header_of(decoder);
  struct context context = {.path = arguments[count - 1], .decoder = decoder};
  CHECK(header.rows > 1 && header.width > 1 && header.depth == 8 && header.block_size == 4);
  context.pixels = allocated(header.width, header.height, 2);
  context.rect = (hmlfc_rect){sizeof context.rect, 0, 0, 0, 0, header.width, header.height, 0};
  CHECK_STATUS(hmlfc_open_renderer(decoder, NULL, &context.renderer, NULL), OK);
  check_options(&context);
  check_blocks(&context);
  check_rects(&context);
  check_pixels(&context);
  check_renderers(&context);
  check_sources(&context);
  hmlfc_close(decoder); /* the renderer goes on */
  check_cameras(&context, header);
  check_end(&context.pixels);
  free(context.pixels.data);
  hmlfc_close_renderer(context.renderer);
  return 0;
}
