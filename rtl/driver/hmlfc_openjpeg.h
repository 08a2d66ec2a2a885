/* JPEG 2000 for hmlfc_fill_key_images, by OpenJPEG 2.5 or newer. OpenJPEG allocates. */
#ifndef HMLFC_OPENJPEG_H
#define HMLFC_OPENJPEG_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An hmlfc_decode_plane; `context` is not used. */
int hmlfc_openjpeg_decode(void* context, const uint8_t* codestream, size_t bytes, uint32_t width,
                          uint32_t height, unsigned bits, int is_signed, int16_t* samples);

#ifdef __cplusplus
}
#endif

#endif
