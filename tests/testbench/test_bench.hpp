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
