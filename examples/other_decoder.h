/* A decoder with an interface of its own, which wrap_decoder.c adapts. It stands for yours. */
#ifndef OTHER_DECODER_H
#define OTHER_DECODER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct other_decoder other_decoder;

typedef struct other_info {
  uint32_t rows, cols, width, height, depth, has_full_chroma, block_side, levels;
} other_info;

/* Null on failure; *error is then its number in annex A of the specification. */
other_decoder* other_open(const uint8_t* bytes, size_t size, int* error);
other_info other_get_info(const other_decoder* decoder);

/* View number row * cols + col as three planes R, G, B of width * height samples. Returns 0 or the
 * error. */
int other_decode_planes(other_decoder* decoder, uint32_t view, uint16_t* planes);

/* One block of plane 'Y', 'o' or 'g' of a view; `level` is counted from the top of the tree. */
int other_decode_block(other_decoder* decoder, uint32_t view, char plane, uint32_t block_x,
                       uint32_t block_y, uint32_t level, int32_t* samples);
void other_close(other_decoder* decoder);

#ifdef __cplusplus
}
#endif

#endif
