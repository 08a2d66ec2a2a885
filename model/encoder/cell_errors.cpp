#include "encoder/cell_errors.hpp"

#include <numeric>

namespace hmlfc {

CellErrors::CellErrors(const MotionTask& task, const std::vector<PaletteEntry>& symbols)
    : task_(task),
      sources_(task.sources),
      symbols_(symbols),
      estimate_(task.lambda, shift_of(task.lambda)),
      bound_(reference_bound(Plane::kY, sources_.header.depth, sources_.keyed)),
      side_(1u << sources_.header.disparity_grid_log2) {}

void CellErrors::go_to(uint32_t gx, uint32_t gy, uint32_t count) {
  gx_ = gx;
  gy_ = gy;
  cells_ = count;
  columns_ = std::min(count * side_, sources_.header.width - gx * side_);
  rows_ = std::min(side_, sources_.header.height - gy * side_);
  look_up(1);
  for (uint32_t y = 0; y < rows_ && !sources_.keyed; ++y) {
    const SquareRow row = squares_at(0, count, y, false);
    for (uint32_t x = 0; x < columns_; ++x) {
      minus_[y * kMaxColumns + x] = static_cast<int16_t>(-row.target[x]);
    }
  }
}

int64_t CellErrors::of_first_symbol() {
  const PaletteEntry& symbol = symbols_.front();
  if (symbol.choice == kChoiceNone) predicted_[0].fill(0);
  for (uint32_t i = 0; i < cells_ && symbol.choice != kChoiceNone;) {
    i = predict(references_of_set(symbol.reference_set), i, symbol.choice, predicted_[0]);
  }
  weigh_squares(first_.data());
  return std::accumulate(first_.begin(), first_.begin() + cells_, int64_t{0});
}

void CellErrors::run(int32_t* errors, size_t stride) {
  if (!sources_.keyed) of_first_symbol();
  const unsigned references = sources_.two_references() ? 4 : 1;
  for (unsigned choice = 1; choice <= task_.choices; ++choice) {
    if (choice > 1) look_up(choice);
    for (uint32_t i = 0; i < cells_; ++i) {
      known_[choice][i] = known_[alike_[choice][i]][i];
      const uint32_t first = i;
      for (uint32_t next = i; i < cells_ && alike_[choice][i] == choice; i = next) {
        for (uint8_t k = 0; k < references; ++k) {
          next = predict({1, {k, k}}, i, choice, predicted_[k]);
        }
      }
      if (i == first) continue;
      evaluate(first, i, choice, false);
      if (!sources_.keyed) evaluate(first, i, choice, true);
      --i;
    }
  }
  for (const PaletteEntry& symbol : symbols_) {
    const size_t which = symbol.reference_set + (symbol.negative ? kReferenceSets : 0);
    for (uint32_t i = 0; i < cells_; ++i) {
      errors[i] = symbol.choice == kChoiceNone ? first_[i] : known_[symbol.choice][i][which];
    }
    errors += stride;
  }
}

void CellErrors::of_vector(const PaletteEntry& symbol, int32_t* errors) {
  const size_t k = references_of_set(symbol.reference_set).reference[0];
  interpolate_rect(
      {displaced(*task_.references[k], static_cast<int32_t>(gx_ * side_),
                 static_cast<int32_t>(gy_ * side_), sources_.vector(k, symbol, 0, false))},
      1, bound_, {predicted_[0].data(), kMaxColumns, columns_, rows_});
  weigh_squares(errors);
}

// Writes what predicted_[0] leaves of the cells.
void CellErrors::weigh_squares(int32_t* errors) {
  std::fill_n(errors, cells_, 0);
  for (uint32_t y = 0; y < rows_; y += 4) {
    square_errors(squares_at(0, cells_, y, false), &predicted_[0][y * kMaxColumns],
                  squares_.data());
    for (uint32_t k = 0; k < ceil_div(columns_, 4u); ++k) {
      errors[4 * k / side_] += estimate(squares_[k]);
    }
  }
}

// Looks up the disparities of `choice` in the cells, after those of all choices before it.
void CellErrors::look_up(unsigned choice) {
  for (uint32_t i = 0; i < cells_; ++i) {
    const int32_t d = sources_.disparity(gx_ + i, gy_, choice);
    uint8_t alike = 1;
    while (alike < choice && disparities_[alike][i] != d) ++alike;
    disparities_[choice][i] = d;
    alike_[choice][i] = alike;
  }
}

// Predicts the cells from `first` on that have one disparity, which no choice before has; returns
// where they end. For two references, the mean of their rounded predictions is near enough to
// decide on.
uint32_t CellErrors::predict(const ReferenceSet& refs, uint32_t first, unsigned choice,
                             Samples& out) const {
  const auto& disparities = disparities_[choice];
  const int32_t d = disparities[first];
  uint32_t end = first + 1;
  while (end < cells_ && disparities[end] == d && alike_[choice][end] == choice) ++end;
  std::array<DisplacedReference, 2> parts;
  for (size_t i = 0; i < refs.count; ++i) {
    const size_t k = refs.reference[i];
    parts[i] = displaced(*task_.references[k], static_cast<int32_t>((gx_ + first) * side_),
                         static_cast<int32_t>(gy_ * side_), sources_.vector(k, d, false));
  }
  interpolate_rect(parts, refs.count, bound_,
                   {&out[first * side_], kMaxColumns, columns(first, end), rows_});
  return end;
}

SquareRow CellErrors::squares_at(uint32_t first, uint32_t end, uint32_t y, bool negative) const {
  const int16_t* plus = task_.target.row(gy_ * side_ + y).data() + (gx_ + first) * side_;
  return {negative ? &minus_[y * kMaxColumns + first * side_] : plus,
          negative ? kMaxColumns : task_.target.width, kMaxColumns, columns(first, end),
          std::min(4u, rows_ - y)};
}

// Weighs cells that are predicted, or the other sign of their predictions.
void CellErrors::evaluate(uint32_t first, uint32_t end, unsigned choice, bool negative) {
  OfCell* cells = &known_[choice][first];
  const unsigned sets = sources_.two_references() ? kReferenceSets : 1;
  const size_t begin = negative ? kReferenceSets : 0;
  for (uint32_t i = 0; i < end - first; ++i) std::fill_n(cells[i].begin() + begin, sets, 0);
  for (uint32_t y = 0; y < rows_; y += 4) {
    const SquareRow row = squares_at(first, end, y, negative);
    const size_t at = y * kMaxColumns + first * side_;
    if (sets == 1) {
      square_errors(row, &predicted_[0][at], squares_.data());
    } else {
      set_errors(row,
                 {&predicted_[0][at], &predicted_[1][at], &predicted_[2][at], &predicted_[3][at]},
                 squares_.data(), kSquares);
    }
    for (uint32_t k = 0; k < ceil_div(row.columns, 4u); ++k) {
      OfCell& cell = cells[4 * k / side_];
      for (size_t set = 0; set < sets; ++set) {
        cell[begin + set] += estimate(squares_[set * kSquares + k]);
      }
    }
  }
}

}  // namespace hmlfc
