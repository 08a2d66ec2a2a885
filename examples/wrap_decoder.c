/* Wraps a decoder as a library that the conformance suite can test, in C99:
 *   cc -shared -fPIC -I installed/include wrap_decoder.c other_decoder.c -o libwrap_decoder.so
 *   hmlfc conform --dut ./libwrap_decoder.so -o report
 * Each function translates one call of hmlfc_dut.h into calls of other_decoder.h. */
#include <hmlfc/hmlfc_dut.h>
#include <stdlib.h>

#include "other_decoder.h"

struct hmlfc_dut {
  other_decoder* decoder;
  other_info info;
};

uint32_t hmlfc_dut_abi(void) { return HMLFC_DUT_ABI; }

const char* hmlfc_dut_name(void) { return "other decoder 1.0"; }

int hmlfc_dut_open(const uint8_t* bytes, size_t size, hmlfc_dut** dut) {
  int error = 0;
  other_decoder* decoder = other_open(bytes, size, &error);
  *dut = NULL;
  if (decoder == NULL) return error;
  *dut = malloc(sizeof **dut);
  if (*dut == NULL) {
    other_close(decoder);
    return 26; /* out_of_memory */
  }
  (*dut)->decoder = decoder;
  (*dut)->info = other_get_info(decoder);
  return 0;
}

int hmlfc_dut_get_geometry(const hmlfc_dut* dut, hmlfc_dut_geometry* geometry) {
  const other_info* info = &dut->info;
  geometry->rows = info->rows;
  geometry->cols = info->cols;
  geometry->width = info->width;
  geometry->height = info->height;
  geometry->depth = info->depth;
  geometry->chroma_format = info->has_full_chroma;
  geometry->block_log2 = info->block_side == 8 ? 3 : info->block_side == 4 ? 2 : 1;
  geometry->tree_height = info->levels - 1;
  return 0;
}

int hmlfc_dut_decode_view(hmlfc_dut* dut, uint32_t row, uint32_t col, uint16_t* rgb) {
  const size_t pixels = (size_t)dut->info.width * dut->info.height;
  uint16_t* planes = malloc(3 * pixels * sizeof *planes);
  int error;
  if (planes == NULL) return 26; /* out_of_memory */
  error = other_decode_planes(dut->decoder, row * dut->info.cols + col, planes);
  for (size_t i = 0; error == 0 && i < 3 * pixels; ++i) {
    rgb[i] = planes[i % 3 * pixels + i / 3];
  }
  free(planes);
  return error;
}

int hmlfc_dut_decode_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                           uint32_t block_x, uint32_t block_y, uint32_t stop_level,
                           int32_t* samples) {
  return other_decode_block(dut->decoder, row * dut->info.cols + col, "Yog"[plane], block_x,
                            block_y, dut -> info.levels - 1 - stop_level, samples);
}

void hmlfc_dut_close(hmlfc_dut* dut) {
  if (dut == NULL) return;
  other_close(dut->decoder);
  free(dut);
}
