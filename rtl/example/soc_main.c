/* The program of soc.sv: decodes one view of a stream to memory with the driver, and writes it as a
 * PPM. What is of this system alone stands in soc_bus.h; on yours, the rest stays as it is. */
#include <stdio.h>
#include <string.h>

#include "hmlfc_driver.h"
#include "hmlfc_openjpeg.h"
#include "hmlfc_registers.h"
#include "soc_bus.h"

enum { RING_SIZE = 16, PAGE = 4096, WAIT_CLOCKS = 1000, MAX_WAITS = 10000 };

static struct hmlfc_unit unit;

static uint32_t read_register(void* context, uint32_t offset) {
  (void)context;
  return soc_bus_read(offset);
}

static void write_register(void* context, uint32_t offset, uint32_t value) {
  (void)context;
  soc_bus_write(offset, value);
}

/* Sleeps until the interrupt or for a while; then does what a handler would. */
static int wait_for_unit(void* context) {
  static unsigned in_vain;
  (void)context;
  soc_sleep(WAIT_CLOCKS);
  in_vain = hmlfc_unit_events(&unit) != 0 ? 0 : in_vain + 1;
  return in_vain > MAX_WAITS;
}

/* The next free page and what follows it. */
static struct hmlfc_buffer allocate(uint64_t* free, uint64_t bytes) {
  const struct hmlfc_buffer buffer = {soc_memory() + *free, *free, (size_t)bytes};
  *free += (bytes + 32 + PAGE - 1) / PAGE * PAGE;
  return buffer;
}

static int fail(const char* what, int code) {
  fprintf(stderr, "soc: %s: %d\n", what, code);
  return code == 0 ? 1 : code;
}

static int load_file(const char* name, struct hmlfc_buffer* file, uint64_t* free) {
  FILE* input = fopen(name, "rb");
  size_t count;
  if (input == NULL) return fail("cannot open the stream", 1);
  *file = allocate(free, soc_memory_bytes() / 2);
  count = fread(file->cpu, 1, file->bytes, input);
  if (!feof(input)) {
    fclose(input);
    return fail("the stream is too large for the memory", 1);
  }
  fclose(input);
  *free = file->bus;
  *file = allocate(free, count);
  return 0;
}

static int write_picture(const char* name, const struct hmlfc_buffer* picture, uint32_t pitch,
                         const struct hmlfc_stream* stream) {
  FILE* output = fopen(name, "wb");
  int ok = output != NULL && fprintf(output, "P6\n%u %u\n255\n", stream->width, stream->height) > 0;
  for (uint32_t y = 0; ok && y < stream->height; ++y) {
    ok = fwrite(picture->cpu + (size_t)y * pitch, 3, stream->width, output) == stream->width;
  }
  if (output != NULL && fclose(output) != 0) ok = 0;
  return ok ? 0 : fail("cannot write the picture", 1);
}

/* Key images, LOAD, residuals. */
static int prepare(const struct hmlfc_stream* stream, const struct hmlfc_buffer* file,
                   uint64_t* free) {
  const struct hmlfc_buffer area = allocate(free, stream->area_bytes);
  const struct hmlfc_buffer samples = allocate(free, (uint64_t)stream->width * stream->height * 2);
  struct hmlfc_error error;
  uint64_t failed;
  int code;
  if (*free > soc_memory_bytes()) return fail("the memory is too small", 1);
  code = hmlfc_fill_key_images(stream, &area, hmlfc_openjpeg_decode, NULL,
                               (int16_t*)(void*)samples.cpu, samples.bytes / 2, &failed, &error);
  if (code != 0) return fail("key images", code);
  if (error.code != 0) fail("a key image does not decode", error.code);
  if ((code = hmlfc_unit_load(&unit, stream, file->bus, &area)) != 0) return fail("LOAD", code);
  code = hmlfc_unit_fill_residuals(&unit, stream, &area, &failed);
  return code == 0 ? 0 : fail("residuals", code);
}

static int decode(const struct hmlfc_stream* stream, unsigned row, unsigned col, const char* out,
                  uint64_t* free) {
  const uint32_t pitch = (stream->width * 3 + 15) / 16 * 16;
  const struct hmlfc_buffer picture = allocate(free, (uint64_t)pitch * stream->height);
  struct hmlfc_descriptor view;
  struct hmlfc_status status;
  int code;
  if (*free > soc_memory_bytes()) return fail("the memory is too small", 1);
  memset(&view, 0, sizeof view);
  view.row = (uint16_t)row;
  view.col = (uint16_t)col;
  view.format = HMLFC_FORMAT_RGB888;
  view.width = (uint16_t)stream->width;
  view.height = (uint16_t)stream->height;
  view.destination = picture.bus;
  view.pitch = pitch;
  if ((code = hmlfc_unit_give(&unit, &view)) != 0) return fail("the descriptor", code);
  if ((code = hmlfc_unit_wait(&unit, &status)) != 0) return fail("the view", code);
  if (status.result != HMLFC_DONE) return fail("the first error of a block", status.first_error);
  soc_invalidate(NULL, picture.cpu, (size_t)pitch * stream->height);
  return out[0] == '\0' ? 0 : write_picture(out, &picture, pitch, stream);
}

int soc_main(const char* name, unsigned row, unsigned col, const char* out) {
  const struct hmlfc_io io = {NULL, read_register, write_register, wait_for_unit,
                              soc_clean, soc_invalidate};
  uint64_t free = PAGE;
  const struct hmlfc_buffer rings = allocate(&free, HMLFC_RINGS_BYTES(RING_SIZE));
  struct hmlfc_buffer file = {NULL, 0, 0};
  struct hmlfc_stream stream;
  struct hmlfc_error error;
  int code = hmlfc_unit_open(&unit, &io, &rings, RING_SIZE);
  if (code != 0) return fail("the unit", code);
  hmlfc_unit_enable_events(&unit, HMLFC_REG_INTERRUPT_ENABLE_DONE_MASK);
  if ((code = load_file(name, &file, &free)) != 0) return code;
  code = hmlfc_stream_open(&stream, file.cpu, file.bytes, &unit.limits, &error);
  if (code == 0) code = hmlfc_stream_check_sections(&stream, &error);
  if (code != 0) return fail("the stream", code);
  if ((code = prepare(&stream, &file, &free)) != 0) return code;
  return decode(&stream, row, col, out, &free);
}
