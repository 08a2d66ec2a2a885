/* Implements hmlfc_dut.h by hmlfc.h: `hmlfc conform` runs the suite on the C interface, in strict C99. */
#include <hmlfc/hmlfc.h>
#include <hmlfc/hmlfc_dut.h>
#include <stdlib.h>

struct hmlfc_dut {
  hmlfc_decoder* decoder;
  hmlfc_header header;
};

uint32_t hmlfc_dut_abi(void) { return HMLFC_DUT_ABI; }

const char* hmlfc_dut_name(void) { return "hmlfc.h"; }

const char* hmlfc_dut_error_name(int status) { return hmlfc_status_name(status); }

void hmlfc_dut_close(hmlfc_dut* dut) {
  if (dut == NULL) return;
  hmlfc_close(dut->decoder);
  free(dut);
}

int hmlfc_dut_open(const uint8_t* bytes, size_t size, hmlfc_dut** dut) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_dut* opened = calloc(1, sizeof *opened);
  int status;
  *dut = NULL;
  if (opened == NULL) return HMLFC_STATUS_OUT_OF_MEMORY;
  opened->header.struct_size = sizeof opened->header;
  status = hmlfc_open_memory(bytes, size, NULL, &opened->decoder, &failure);
  if (status == HMLFC_STATUS_OK) {
    status = hmlfc_get_header(opened->decoder, &opened->header, &failure);
  }
  if (status == HMLFC_STATUS_OK) {
    *dut = opened;
  } else {
    hmlfc_dut_close(opened);
  }
  return status;
}

int hmlfc_dut_get_geometry(const hmlfc_dut* dut, hmlfc_dut_geometry* geometry) {
  const hmlfc_header* header = &dut->header;
  geometry->rows = header->rows;
  geometry->cols = header->cols;
  geometry->width = header->width;
  geometry->height = header->height;
  geometry->depth = header->depth;
  geometry->chroma_format = header->chroma_format;
  geometry->block_log2 = header->block_size == 8 ? 3 : header->block_size / 2;
  geometry->tree_height = header->tree_height;
  return 0;
}

int hmlfc_dut_decode_view(hmlfc_dut* dut, uint32_t row, uint32_t col, uint16_t* rgb) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_pixels pixels = {.struct_size = sizeof pixels};
  const size_t samples = (size_t)3 * dut->header.width * dut->header.height;
  int status;
  pixels.data = rgb;
  pixels.sample_bytes = dut->header.depth == 8 ? 1 : 2;
  pixels.bytes = samples * pixels.sample_bytes;
  status = hmlfc_decode_view(dut->decoder, row, col, &pixels, &failure);
  if (pixels.sample_bytes == 1) {
    for (size_t i = samples; i-- > 0;) rgb[i] = ((const uint8_t*)rgb)[i];
  }
  return status;
}

int hmlfc_dut_decode_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                           uint32_t block_x, uint32_t block_y, uint32_t stop_level,
                           int32_t* samples) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_block block = {.struct_size = sizeof block};
  block.row = row;
  block.col = col;
  block.plane = plane;
  block.block_x = block_x;
  block.block_y = block_y;
  block.stop_level = stop_level;
  return hmlfc_decode_block(dut->decoder, &block, samples, HMLFC_DUT_BLOCK_SAMPLES, &failure);
}
