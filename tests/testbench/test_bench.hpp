// The one bench of a process of tests, and streams to run on it.
#pragma once

#include <vector>

#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"
#include "systemc/bench.hpp"

namespace hmlfc::tb {

/// SystemC's modules are made once in a process.
inline Bench& test_bench() {
  static Bench bench;
  return bench;
}

/// The stream of a random case of either profile; `block_size` 0 leaves it to the seed.
inline std::vector<uint8_t> random_stream(uint32_t seed, unsigned block_size = 0) {
  auto made = test::random_case_of_any_profile(seed);
  if (block_size != 0) made.params.block_size = block_size;
  made.params.threads = 1;
  const LightField field = test::textured_light_field(made.shape, seed, made.noise);
  return encode(field, made.params)->bytes;
}

/// A stream of profile main with blocks of 4 in every state; one view gives key images alone.
inline std::vector<uint8_t> main_stream(uint32_t rows, uint32_t cols) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = 2;
  params.ref_rows = params.ref_cols = 3;
  params.threads = 1;
  const LightFieldShape shape{rows, cols, 70, 50, 8};
  return encode(test::textured_light_field(shape, 1, 8), params)->bytes;
}

}  // namespace hmlfc::tb
