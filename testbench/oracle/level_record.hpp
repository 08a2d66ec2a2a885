// One block of one image of the tree: the unit's trace record and the golden model's expectation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <hmlfc/format.hpp>
#include <hmlfc/trace.hpp>

#include "arithmetic/motion.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {

using StageValues = std::array<int16_t, kMaxLaneSamples>;

/// One level block. Vectors have meaning for [0, references - 1]; reference only with motion,
/// residual only with a residual, and with an error nothing but the site and the error has.
struct LevelRecord {
  BlockSite site;
  bool key = false;  ///< a block of a key image: only its samples are there
  bool motion = false;
  bool negative = false;
  unsigned references = 0;  ///< [0, 2]
  std::array<SubpelVector, 2> vectors{};
  bool has_residual = false;
  uint8_t error = 0;
  StageValues residual{};
  StageValues reference{};   ///< R of MOT-9
  StageValues prediction{};  ///< A of DEC-3
  StageValues sample{};

  BlockState state() const {
    if (motion) return has_residual ? BlockState::kMotionResidual : BlockState::kMotion;
    return has_residual ? BlockState::kResidual : BlockState::kZero;
  }
};

/// The first field in which a record differs from what was expected.
struct Difference {
  std::string stage;  ///< "index entry", "vector", "residual", "reference", "prediction", "sample"
  std::string field;  ///< such as "ix of reference 0" or "sample (2, 1)"
  int64_t expected = 0;
  int64_t actual = 0;
};

/// Compares two records of the same site, stage by stage in decode order. `inside_x` and `inside_y`
/// in [1, B] are the columns and rows of the block that lie in the plane: others are not compared.
std::optional<Difference> first_difference(const LevelRecord& expected, const LevelRecord& actual,
                                           unsigned block_size, unsigned inside_x,
                                           unsigned inside_y);

/// The first of B x B values that differs inside the plane; null if none does.
std::optional<Difference> first_difference(const int16_t* expected, const int16_t* actual,
                                           const char* stage, unsigned block_size,
                                           unsigned inside_x, unsigned inside_y);

/// "level 2 image 3,4 plane Y block 1,2".
std::string to_string(const BlockSite& site);

}  // namespace hmlfc::tb
