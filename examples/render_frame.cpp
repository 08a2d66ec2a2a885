// Renders one frame from between the views and writes it as a PPM picture.
//   render_frame FILE U V FRAME.ppm       U, V: column and row of the camera, such as 1.5 1.5
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <hmlfc/renderer.hpp>

#include "mapped_file.hpp"

namespace {

// `image` as binary PPM: one byte a sample at depth 8, else two, the higher first. Returns whether
// all of it is in the file.
bool write_ppm(const char* path, const hmlfc::RgbImage& image) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << image.width << ' ' << image.height << '\n' << (1 << image.depth) - 1 << '\n';
  for (const uint16_t sample : image.samples) {
    if (image.depth > 8) file.put(static_cast<char>(sample >> 8));
    file.put(static_cast<char>(sample & 255));
  }
  file.close();
  return file.good();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) {
    std::fprintf(stderr, "usage: render_frame FILE U V FRAME.ppm\n");
    return 2;
  }
  const MappedFile file(arguments[1]);  // outlives the decoder
  // A frame reads a small part of the stream: the checksums of whole sections are left out.
  const auto decoder = hmlfc::Decoder::open(file.bytes(), {.check_sections = false});
  if (!decoder) {
    std::fprintf(stderr, "%s\n", to_string(decoder.error()).c_str());
    return 1;
  }
  hmlfc::Camera camera;
  camera.position = {std::atof(arguments[2]), std::atof(arguments[3]), 0};
  camera.geometry = suitable_geometry(decoder->header());
  const auto record = frame_record(camera, decoder->header());
  if (!record) {
    std::fprintf(stderr, "%s\n", record.error().message.c_str());
    return 1;
  }
  const auto renderer = hmlfc::make_cpu_renderer(*decoder);
  hmlfc::Frame frame;
  if (const auto done = renderer->render(*record, 0, frame); !done) {
    std::fprintf(stderr, "%s\n", to_string(done.error()).c_str());
    return 1;
  }
  if (!write_ppm(arguments[4], frame.image)) {
    std::fprintf(stderr, "%s: cannot write\n", arguments[4]);
    return 1;
  }
  return 0;
}
