// Small light fields and parameters for tests, made from a seed.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

namespace hmlfc::test {

/// The same 32-bit numbers for the same seed on every machine.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  uint32_t operator()() { return static_cast<uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

/// A light field with parallax, an occluder and some noise: pixel (x, y) of view (r, c) shows a
/// smooth texture displaced by the view's position. `noise` in [0, 2^depth - 1] is its amplitude.
inline LightField textured_light_field(const LightFieldShape& shape, uint32_t seed,
                                       uint32_t noise) {
  LightField field(shape);
  Random random(seed);
  const uint32_t peak = (1u << shape.depth) - 1;
  const uint32_t slope = 3 + seed % 5;
  std::vector<uint16_t> row(size_t{shape.width} * 3);
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) {
      for (uint32_t y = 0; y < shape.height; ++y) {
        for (uint32_t x = 0; x < shape.width; ++x) {
          const uint32_t u = x + 2 * c;
          const uint32_t v = y + r;
          const bool occluded = (x + 5 * c) % 17 < 4 && (y + 3 * r) % 13 < 5;
          for (uint32_t channel = 0; channel < 3; ++channel) {
            uint32_t value = (u * slope + v * (2 + channel) + ((u ^ v) & 7) * 6 * channel);
            if (occluded) value = peak - value * 3;
            if (noise > 0) value += random() % (noise + 1);
            row[size_t{x} * 3 + channel] = static_cast<uint16_t>(value & peak);
          }
        }
        field.write_row(r, c, y, row);
      }
    }
  }
  return field;
}

/// Everything that can vary in an encoding, drawn from `random`.
struct RandomCase {
  LightFieldShape shape;
  EncodeParams params;
  uint32_t noise = 0;
};

/// A case of at most 6 x 6 views of at most 70 x 50 pixels.
inline RandomCase random_case(uint32_t seed) {
  Random random(seed);
  const auto pick = [&](uint32_t lo, uint32_t hi) { return lo + random() % (hi - lo + 1); };
  RandomCase made;
  made.shape = {pick(1, 6), pick(1, 6), pick(1, 70), pick(1, 50), 8};
  if (pick(0, 2) == 0) made.shape.depth = static_cast<int>(pick(9, 12));
  made.noise = pick(0, 3) == 0 ? (1u << made.shape.depth) - 1 : pick(0, 8);
  EncodeParams& params = made.params;
  params.profile = Profile::kMain;
  params.method = static_cast<Method>(pick(0, 2));
  params.cluster_rows = pick(1, 3);
  params.cluster_cols = pick(params.cluster_rows == 1 ? 2 : 1, 3);
  params.tree_height = static_cast<int>(pick(0, 4));
  params.block_size = 2u << pick(0, 2);
  params.window = static_cast<int>(pick(0, 3) == 0 ? 0 : pick(1, 20));
  params.ref_rows = pick(1, 5);
  params.ref_cols = pick(1, 5);
  params.chroma = pick(0, 1) == 0 ? ChromaFormat::k420 : ChromaFormat::k444;
  params.main.threshold_ref = pick(0, 200) << (made.shape.depth - 8);
  params.main.threshold_pred = pick(0, 200) << (made.shape.depth - 8);
  params.main.rate_distortion = params.main.threshold_pred % 3 == 1;
  return made;
}

/// The same in profile extended: all methods, presets, qualities and group sizes.
inline RandomCase random_extended_case(uint32_t seed) {
  RandomCase made = random_case(seed);
  Random random(~seed);
  const auto pick = [&](uint32_t lo, uint32_t hi) { return lo + random() % (hi - lo + 1); };
  EncodeParams& params = made.params;
  params.profile = Profile::kExtended;
  params.tree_height = pick(0, 1) == 0 ? 0 : static_cast<int>(pick(1, 3));
  params.window = static_cast<int>(pick(0, 3) == 0 ? 0 : pick(1, 127));
  params.extended.quality = pick(0, 100);
  params.extended.preset = static_cast<Preset>(pick(0, 2));
  params.lossless = pick(0, 5) == 0;
  if (pick(0, 3) == 0) params.chroma.reset();
  if (pick(0, 3) == 0) params.ref_rows = params.ref_cols = 0;
  return made;
}

/// A case of either profile.
inline RandomCase random_case_of_any_profile(uint32_t seed) {
  return seed % 2 == 0 ? random_case(seed / 2) : random_extended_case(seed / 2);
}

}  // namespace hmlfc::test
