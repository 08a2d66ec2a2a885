// Vectors of their own (choice 11 of MOT-5), for blocks that disparities predict badly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "encoder/motion_decision.hpp"

namespace hmlfc {

/// Searches vectors for blocks of one image at a keyed level. Not thread-safe.
class VectorSearch {
 public:
  /// Samples a side of a block.
  static constexpr uint32_t kSide = 16;

  /// `task` must outlive it. `symbols`: the palette entries tried without a search.
  VectorSearch(const MotionTask& task, const std::vector<PaletteEntry>& symbols);

  /// For each reference image the entry with the vector, near that of the disparity in the middle
  /// of `area`, that leaves least to the residual, where that is below `most`. `area`: within the
  /// plane, at most kSide samples a side.
  std::vector<PaletteEntry> run(const Area& area, int64_t most);

 private:
  MotionVector start(const Area& area, size_t k) const;
  int64_t left(const Area& area, size_t k, const MotionVector& vector, int64_t most);
  int64_t descend(const Area& area, size_t k, MotionVector& vector);

  const MotionTask& task_;
  ResidualEstimate estimate_;
  int32_t bound_;
  std::vector<uint8_t> sets_;  // of one reference image each
  std::array<int16_t, size_t{kSide} * 4> predicted_{};
  std::array<uint32_t, kSide / 4> squares_{};
};

}  // namespace hmlfc
