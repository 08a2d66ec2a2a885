/* driver_probe STREAM...: what the driver says of streams, fills into areas and writes into its
 * rings, as text, with a unit of registers alone that does each descriptor at once. It is the same
 * on every processor. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/hmlfc_driver.h"
#include "driver/hmlfc_registers.h"

enum { RING = 4 };
static uint32_t registers[1024];
static uint32_t given; /* CRC of all descriptors */
static _Alignas(64) uint8_t rings[HMLFC_RINGS_BYTES(RING)];

static uint32_t read_register(void* context, uint32_t offset) {
  (void)context;
  return registers[offset / 4];
}

/* The status is that of a unit: little-endian, at the descriptor's place. */
static void write_register(void* context, uint32_t offset, uint32_t value) {
  const size_t place = (value - 1) % RING;
  uint8_t* status = rings + 64 * RING + 16 * place;
  (void)context;
  registers[offset / 4] = value;
  if (offset == HMLFC_REG_VIEW_CONTROL && (value & HMLFC_REG_VIEW_CONTROL_RESET_MASK) != 0) {
    registers[HMLFC_REG_CONSUMER / 4] = 0;
  }
  if (offset != HMLFC_REG_PRODUCER) return;
  given = hmlfc_crc32c(rings + 64 * place, 64, given);
  memcpy(status, rings + 64 * place, 4);
  memset(status + 4, 0, 12);
  status[4] = HMLFC_BLOCK_ERRORS;
  status[8] = 3;
  registers[HMLFC_REG_CONSUMER / 4] = value;
}

static int give_up(void* context) { return context == NULL; }

static int decode(void* context, const uint8_t* bytes, size_t count, uint32_t width,
                  uint32_t height, unsigned bits, int is_signed, int16_t* samples) {
  (void)context;
  for (size_t i = 0; i < (size_t)width * height; ++i) {
    samples[i] = (int16_t)((bytes[i % count] & ((1u << bits) - 1)) - (unsigned)is_signed * 9);
  }
  return 0;
}

static void probe(const uint8_t* file, size_t bytes) {
  const struct hmlfc_io io = {NULL, read_register, write_register, give_up, NULL, NULL};
  const struct hmlfc_buffer ring = {rings, 64, sizeof rings};
  struct hmlfc_buffer area = {NULL, 1 << 20, 0};
  struct hmlfc_stream stream;
  struct hmlfc_error error;
  struct hmlfc_unit unit;
  uint64_t keys, blocks;
  int16_t* samples;
  int code = hmlfc_stream_open(&stream, file, bytes, NULL, &error);
  if (code == HMLFC_OK) code = hmlfc_stream_check_sections(&stream, &error);
  printf("%d in %d at %" PRIu64 "\n", code, error.section, error.offset);
  if (code != HMLFC_OK) return;
  area.bytes = (size_t)stream.area_bytes;
  area.cpu = calloc(area.bytes, 1);
  samples = calloc((size_t)stream.width * stream.height, sizeof *samples);
  code = hmlfc_fill_key_images(&stream, &area, decode, NULL, samples,
                               (size_t)stream.width * stream.height, &keys, &error);
  printf("area %08" PRIx32 ", %d, %" PRIu64 "\n", hmlfc_crc32c(area.cpu, area.bytes, 0), code,
         keys);
  code = hmlfc_unit_open(&unit, &io, &ring, RING);
  if (code == HMLFC_OK) code = hmlfc_unit_load(&unit, &stream, 0, &area);
  if (code == HMLFC_OK) code = hmlfc_unit_fill_residuals(&unit, &stream, &area, &blocks);
  printf("descriptors %08" PRIx32 ", %d, %" PRIu64 "\n", given, code, blocks);
  free(samples);
  free(area.cpu);
}

int main(int count, char** names) {
  registers[HMLFC_REG_ID / 4] = HMLFC_REG_ID_RESET;
  registers[HMLFC_REG_VIEW_ID / 4] = HMLFC_REG_VIEW_ID_RESET;
  for (int i = 1; i < count; ++i) {
    static uint8_t file[1 << 20];
    FILE* input = fopen(names[i], "rb");
    if (input == NULL) return 1;
    probe(file, fread(file, 1, sizeof file, input));
    fclose(input);
  }
  return 0;
}
