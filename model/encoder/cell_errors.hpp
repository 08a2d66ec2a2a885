// Estimates what one grid block ("cell") leaves to the residual under every motion that is tried.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "encoder/motion_decision.hpp"

namespace hmlfc {

/// Evaluates the cells of one image, one after the other. Not thread-safe.
class CellErrors {
 public:
  /// The arguments must outlive it. `symbols`: palette entries to try, whose choices are not
  /// explicit.
  CellErrors(const MotionTask& task, const std::vector<PaletteEntry>& symbols);

  /// Writes the ResidualEstimate of cell (gx, gy) under each symbol to `errors`.
  void run(uint32_t gx, uint32_t gy, int64_t* errors);

 private:
  static constexpr size_t kMaxCellSamples = size_t{32} * 32;
  using CellSamples = std::array<int16_t, kMaxCellSamples>;

  struct Known {
    int32_t disparity;
    std::array<int64_t, 16> errors;
  };

  void load_target();
  int64_t left_by(const int16_t* prediction, bool negative) const;
  template <int kSide>
  int64_t left_of_whole(const int16_t* prediction) const;
  int64_t squares(const int16_t* prediction, bool negative, int32_t x, int32_t y) const;
  const std::array<int64_t, 16>& of_disparity(int32_t d);
  void interpolate_from(size_t k, int32_t d);
  void average(const CellSamples& a, const CellSamples& b);

  const MotionTask& task_;
  ResidualEstimate estimate_;
  const MotionSources& sources_;
  const std::vector<PaletteEntry>& symbols_;
  unsigned sets_;  // reference sets there are
  int32_t size_;
  int32_t bound_;
  Area area_;
  CellSamples target_;
  std::array<CellSamples, 4> predicted_;  // from K0 to K3, with the disparity at hand
  CellSamples mean_;
  std::vector<Known> known_;
};

}  // namespace hmlfc
