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

/// A stream of profile main with 5 x 5 views and blocks in every state.
inline std::vector<uint8_t> main_stream(unsigned block_size) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = 2;
  params.ref_rows = params.ref_cols = 3;
  params.block_size = block_size;
  params.threads = 1;
  const LightFieldShape shape{5, 5, 70, 50, 8};
  return encode(test::textured_light_field(shape, 1, 8), params)->bytes;
}

}  // namespace hmlfc::tb
