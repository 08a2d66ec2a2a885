// What the debug variant of the kernels reports about blocks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "arithmetic/motion.hpp"

namespace hmlfc::gpu {

/// What the debug variant reports about one level of one block. Without an error and not `key`,
/// `prediction` is present; `residual` and `reference` are present where the flags say so.
struct LevelStages {
  int level = 0;
  bool key = false;         ///< a block of a key image: only `sample`
  unsigned references = 0;  ///< 0 without motion, 1 or 2
  bool negative = false;
  std::array<SubpelVector, 2> vectors{};
  bool has_residual = false;
  uint8_t status = 0;
  std::vector<int16_t> residual;  ///< B * B values
  std::vector<int16_t> reference;
  std::vector<int16_t> prediction;
  std::vector<int16_t> sample;
};

/// One block from the first level that is decoded down to its stop level, or to the first with an
/// error.
struct BlockStages {
  uint8_t status = 0;
  std::vector<LevelStages> levels;
};

}  // namespace hmlfc::gpu
