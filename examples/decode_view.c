/* In C99: decodes a view, renders the frame from the middle of all views, writes both as PPM.
 *   decode_view FILE ROW COL VIEW.ppm FRAME.ppm */
#include <hmlfc/hmlfc.h>
#include <stdio.h>
#include <stdlib.h>

static int report(const hmlfc_failure* failure) {
  fprintf(stderr, "%s\n", failure->text);
  return 1;
}

/* Binary PPM: one byte a sample at depth 8, else two, the higher first. Returns 0 for success. */
static int write_ppm(const char* path, const hmlfc_header* header, const uint16_t* samples) {
  FILE* file = fopen(path, "wb");
  const size_t count = (size_t)3 * header->width * header->height;
  int failed;
  if (file == NULL) return 1;
  fprintf(file, "P6\n%u %u\n%u\n", (unsigned)header->width, (unsigned)header->height,
          (1u << header->depth) - 1);
  for (size_t i = 0; i < count; ++i) {
    if (header->depth > 8) fputc(samples[i] >> 8, file);
    fputc(samples[i] & 255, file);
  }
  failed = ferror(file);
  return fclose(file) != 0 || failed;
}

/* Decodes and renders to `samples`, which `pixels` describes. */
static int draw(hmlfc_decoder* decoder, char** arguments, const hmlfc_pixels* pixels) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_header header = {.struct_size = sizeof header};
  const hmlfc_camera camera = {.struct_size = sizeof camera}; /* in the middle of the views */
  hmlfc_renderer* renderer;
  const uint32_t row = (uint32_t)strtoul(arguments[2], NULL, 10);
  const uint32_t col = (uint32_t)strtoul(arguments[3], NULL, 10);
  hmlfc_get_header(decoder, &header, NULL);
  if (hmlfc_decode_view(decoder, row, col, pixels, &failure)) return report(&failure);
  if (write_ppm(arguments[4], &header, pixels->data)) return perror(arguments[4]), 1;
  if (hmlfc_open_renderer(decoder, NULL, &renderer, &failure)) return report(&failure);
  if (hmlfc_render(renderer, &camera, pixels, &failure)) {
    hmlfc_close_renderer(renderer);
    return report(&failure);
  }
  hmlfc_close_renderer(renderer);
  if (write_ppm(arguments[5], &header, pixels->data)) return perror(arguments[5]), 1;
  return 0;
}

int main(int count, char** arguments) {
  hmlfc_failure failure = {.struct_size = sizeof failure};
  hmlfc_header header = {.struct_size = sizeof header};
  hmlfc_pixels pixels = {.struct_size = sizeof pixels, .sample_bytes = sizeof(uint16_t)};
  hmlfc_decoder* decoder;
  int status = 1;
  if (count != 6) {
    fprintf(stderr, "usage: decode_view FILE ROW COL VIEW.ppm FRAME.ppm\n");
    return 2;
  }
  if (hmlfc_open_file(arguments[1], NULL, &decoder, &failure)) return report(&failure);
  hmlfc_get_header(decoder, &header, NULL);
  pixels.bytes = (size_t)3 * header.width * header.height * sizeof(uint16_t);
  pixels.data = malloc(pixels.bytes);
  if (pixels.data == NULL) {
    fprintf(stderr, "no memory for a view\n");
  } else {
    status = draw(decoder, arguments, &pixels);
  }
  free(pixels.data);
  hmlfc_close(decoder);
  return status;
}
