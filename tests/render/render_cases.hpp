// Light fields, streams and cameras for the tests of the renderers, made from a seed.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"

namespace hmlfc::test {

/// A stream's bytes with their decoder.
struct OpenedStream {
  std::vector<uint8_t> bytes;
  std::optional<Decoder> decoder;

  explicit OpenedStream(std::vector<uint8_t> file, const OpenOptions& options = {})
      : bytes(std::move(file)) {
    auto opened = Decoder::open(bytes, options);
    if (opened) decoder.emplace(std::move(*opened));
  }
};

/// The stream of random case `seed` of either profile.
inline std::vector<uint8_t> random_stream(uint32_t seed) {
  const RandomCase made = random_case_of_any_profile(seed);
  return encode(textured_light_field(made.shape, seed, made.noise), made.params)->bytes;
}

/// Changes three bytes after the header of a stream.
inline void damage(Random& random, std::vector<uint8_t>& stream) {
  const size_t header = stream[10] + 256u * stream[11];
  for (int n = 0; n < 3 && header < stream.size(); ++n) {
    stream[header + random() % (stream.size() - header)] ^=
        static_cast<uint8_t>(1 + random() % 255);
  }
}

/// A camera that usually sees part of a light field of this header: near or far, straight or
/// turned, with a narrow or a wide aperture.
inline Camera random_camera(Random& random, const StreamHeader& header) {
  const auto unit = [&] { return random() / 4294967296.0; };
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * unit(); };
  Camera camera;
  camera.filter = static_cast<Filter>(random() % 3);
  camera.aperture = random() % 3 == 0 ? static_cast<int>(random() % 4) : 0;
  if (random() % 4 != 0) {
    camera.frame_width = 1 + random() % 48;
    camera.frame_height = 1 + random() % 40;
  }
  if (random() % 3 == 0) camera.focal = between(20, 200);
  if (random() % 2 == 0) camera.shear = between(-3, 3);
  if (random() % 2 == 0) camera.focus = between(-6, 6);
  if (random() % 4 == 0) camera.row_pitch = (random() % 2 == 0 ? 1 : -1) * between(0.5, 2);
  WorldPoint position{between(-0.4, header.cols - 0.6), between(-0.4, header.rows - 0.6), 0};
  if (random() % 4 == 0) position.u = std::floor(position.u + 0.5);
  if (random() % 4 == 0) position.v = std::floor(position.v + 0.5);
  if (random() % 2 == 0) position.z = between(-6, 6);
  camera.position = position;
  if (random() % 2 == 0) {
    camera.look_at = {position.u + between(-1, 1), position.v + between(-1, 1), position.z + 2};
  }
  if (random() % 2 == 0) camera.tan_half = between(0.05, 1.2);
  return camera;
}

/// A random camera as above; every other one has geometry.
inline Camera random_camera_with_geometry(Random& random, const StreamHeader& header) {
  Camera camera = random_camera(random, header);
  camera.geometry = static_cast<GeometrySource>(random() % 2);
  if (random() % 4 == 0) {  // with the pixels of views, where disparities are fine (REC-2)
    camera.frame_width = camera.frame_height = {};
    camera.look_at.reset();
    camera.tan_half.reset();
    camera.shear = 0;
  }
  return camera;
}

}  // namespace hmlfc::test
