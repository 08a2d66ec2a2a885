#include "hmlfc_openjpeg.h"

#include <errno.h>
#include <openjpeg.h>
#include <string.h>

#include "hmlfc_driver.h"

struct source {
  const uint8_t* bytes;
  size_t count, at;
};

static OPJ_SIZE_T read_source(void* buffer, OPJ_SIZE_T count, void* user) {
  struct source* source = user;
  const size_t left = source->count - source->at;
  const size_t there = count < left ? count : left;
  if (there == 0) return (OPJ_SIZE_T)-1;
  memcpy(buffer, source->bytes + source->at, there);
  source->at += there;
  return there;
}

static OPJ_OFF_T skip_source(OPJ_OFF_T count, void* user) {
  struct source* source = user;
  if (count < 0 || (uint64_t)count > source->count - source->at) return -1;
  source->at += (size_t)count;
  return count;
}

static OPJ_BOOL seek_source(OPJ_OFF_T position, void* user) {
  struct source* source = user;
  if (position < 0 || (uint64_t)position > source->count) return OPJ_FALSE;
  source->at = (size_t)position;
  return OPJ_TRUE;
}

int hmlfc_openjpeg_decode(void* context, const uint8_t* codestream, size_t bytes, uint32_t width,
                          uint32_t height, unsigned bits, int is_signed, int16_t* samples) {
  struct source source = {codestream, bytes, 0};
  opj_stream_t* stream;
  opj_codec_t* codec;
  opj_image_t* image = NULL;
  opj_dparameters_t parameters;
  int decoded = 0;
  int no_memory;
  (void)context;
  (void)bits; /* hmlfc_has_key_image_head has checked them, and OpenJPEG clamps to them */
  (void)is_signed;
  errno = 0; /* the C library sets it where it cannot allocate; OpenJPEG says no reason */
  stream = opj_stream_create(bytes, OPJ_TRUE);
  codec = opj_create_decompress(OPJ_CODEC_J2K);
  opj_set_default_decoder_parameters(&parameters);
  if (stream != NULL && codec != NULL) {
    opj_stream_set_user_data(stream, &source, NULL);
    opj_stream_set_user_data_length(stream, bytes);
    opj_stream_set_read_function(stream, read_source);
    opj_stream_set_skip_function(stream, skip_source);
    opj_stream_set_seek_function(stream, seek_source);
    decoded = opj_setup_decoder(codec, &parameters) &&
              opj_decoder_set_strict_mode(codec, OPJ_TRUE) && opj_codec_set_threads(codec, 0) &&
              opj_read_header(stream, codec, &image) && opj_decode(codec, stream, image) &&
              opj_end_decompress(codec, stream) && image->comps[0].data != NULL &&
              image->comps[0].w == width && image->comps[0].h == height;
  }
  no_memory = errno == ENOMEM;
  for (size_t i = 0; decoded && i < (size_t)width * height; ++i) {
    samples[i] = (int16_t)image->comps[0].data[i];
  }
  opj_image_destroy(image);
  opj_destroy_codec(codec);
  opj_stream_destroy(stream);
  if (decoded) return 0;
  return no_memory ? HMLFC_OUT_OF_MEMORY : HMLFC_BAD_TOP_CRC;
}
