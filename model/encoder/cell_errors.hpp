// Estimates what grid blocks ("cells") leave to the residual under every motion that is tried.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "encoder/error_kernels.hpp"
#include "encoder/motion_decision.hpp"

namespace hmlfc {

/// Evaluates the cells of one image, those of a row of a motion tile at a time. Not thread-safe.
class CellErrors {
 public:
  /// The arguments must outlive it. `symbols`: palette entries to try, whose choices are not
  /// explicit; the first is that of empty tiles.
  CellErrors(const MotionTask& task, const std::vector<PaletteEntry>& symbols);

  /// Goes to cells (gx, gy) to (gx + count - 1, gy).
  void go_to(uint32_t gx, uint32_t gy, uint32_t count);

  /// The sum of the cells' ResidualEstimates under the first symbol.
  int64_t of_first_symbol();

  /// Writes the ResidualEstimates of the cells under symbol s from errors[s * stride] on.
  void run(int32_t* errors, size_t stride);

  /// Writes those under `symbol`, whose choice is kChoiceVector and whose reference is one, from
  /// errors[0] on.
  void of_vector(const PaletteEntry& symbol, int32_t* errors);

 private:
  static constexpr uint32_t kMaxColumns = 128;  // of a motion tile
  static constexpr uint32_t kMaxRows = 8;       // of a cell
  static constexpr uint32_t kSquares = kMaxColumns / 4;

  using Samples = std::array<int16_t, size_t{kMaxColumns} * kMaxRows>;
  using OfCell = std::array<int32_t, 2 * kReferenceSets>;  // by reference set, of +, then of -

  void look_up(unsigned choice);
  uint32_t columns(uint32_t first, uint32_t end) const {
    return std::min(end * side_, columns_) - first * side_;
  }
  uint32_t predict(const ReferenceSet& refs, uint32_t first, unsigned choice, Samples& out) const;
  SquareRow squares_at(uint32_t first, uint32_t end, uint32_t y, bool negative) const;
  void weigh_squares(int32_t* errors);
  void evaluate(uint32_t first, uint32_t end, unsigned choice, bool negative);
  int32_t estimate(uint32_t square) const { return static_cast<int32_t>(estimate_(square)); }

  const MotionTask& task_;
  const MotionSources& sources_;
  const std::vector<PaletteEntry>& symbols_;
  ResidualEstimate estimate_;
  int32_t bound_;
  uint32_t side_;  // of a cell, 4 or 8
  uint32_t gx_ = 0, gy_ = 0, cells_ = 0;
  uint32_t columns_ = 0, rows_ = 0;                            // of samples
  Samples minus_{};                                            // the target with the other sign
  std::array<Samples, 4> predicted_{};                         // from K0 to K3
  std::array<uint32_t, kReferenceSets * kSquares> squares_{};  // [set][square]
  // By cell, of the first symbol, which is none where levels are not keyed.
  std::array<int32_t, kSquares> first_{};
  // [choice][cell]: the disparity, the first choice that has it, and estimates.
  std::array<std::array<int32_t, kSquares>, 10> disparities_{};
  std::array<std::array<uint8_t, kSquares>, 10> alike_{};
  std::array<std::array<OfCell, kSquares>, 10> known_{};
};

}  // namespace hmlfc
