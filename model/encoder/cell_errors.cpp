#include "encoder/cell_errors.hpp"

#include <algorithm>

namespace hmlfc {

CellErrors::CellErrors(const MotionTask& task, const std::vector<PaletteEntry>& symbols)
    : task_(task),
      estimate_(task.lambda),
      sources_(task.sources),
      symbols_(symbols),
      sets_(task.sources.two_references() ? 8 : 1),
      size_(1 << sources_.header.disparity_grid_log2),
      bound_(reference_bound(Plane::kY, sources_.header.depth, sources_.keyed)) {}

void CellErrors::run(uint32_t gx, uint32_t gy, int64_t* errors) {
  area_ = {static_cast<int32_t>(gx) * size_, static_cast<int32_t>(gy) * size_, 0, 0};
  area_.width = std::min(size_, static_cast<int32_t>(sources_.header.width) - area_.x);
  area_.height = std::min(size_, static_cast<int32_t>(sources_.header.height) - area_.y);
  load_target();
  known_.clear();
  for (size_t s = 0; s < symbols_.size(); ++s) {
    const PaletteEntry& symbol = symbols_[s];
    if (symbol.choice == kChoiceNone) {
      errors[s] = left_by(nullptr, false);
      continue;
    }
    const int32_t d = sources_.disparity(gx, gy, symbol.choice);
    errors[s] = of_disparity(d)[symbol.reference_set + (symbol.negative ? 8u : 0u)];
  }
}

void CellErrors::load_target() {
  int16_t* out = target_.data();
  for (int32_t j = 0; j < area_.height; ++j) {
    const int16_t* row = task_.target.row(static_cast<uint32_t>(area_.y + j)).data() + area_.x;
    for (int32_t i = 0; i < area_.width; ++i) *out++ = row[i];
  }
}

// left_by() for a cell of known size, which compilers turn into vectors.
template <int kSide>
int64_t CellErrors::left_of_whole(const int16_t* prediction) const {
  std::array<int32_t, size_t{kSide}> columns{};
  int64_t sum = 0;
  for (int y = 0; y < kSide; y += 4) {
    columns.fill(0);
    for (int k = y * kSide; k < (y + 4) * kSide; k += kSide) {
      for (int x = 0; x < kSide; ++x) {
        const int32_t error = target_[size_t(k + x)] - prediction[k + x];
        columns[size_t(x)] += error * error;
      }
    }
    for (size_t x = 0; x < kSide; x += 4) {
      sum += estimate_(columns[x] + columns[x + 1] + columns[x + 2] + columns[x + 3]);
    }
  }
  return sum;
}

// `prediction` may be null: 0.
int64_t CellErrors::left_by(const int16_t* prediction, bool negative) const {
  const bool whole = area_.width == area_.height && prediction != nullptr && !negative;
  if (whole && area_.width == 8) return left_of_whole<8>(prediction);
  if (whole && area_.width == 4) return left_of_whole<4>(prediction);
  int64_t sum = 0;
  for (int32_t y = 0; y < area_.height; y += 4) {
    for (int32_t x = 0; x < area_.width; x += 4) {
      sum += estimate_(squares(prediction, negative, x, y));
    }
  }
  return sum;
}

// The squared error of the 4x4 samples from (x, y) on that lie inside.
int64_t CellErrors::squares(const int16_t* prediction, bool negative, int32_t x, int32_t y) const {
  int32_t sum = 0;
  for (int32_t j = y; j < std::min(y + 4, area_.height); ++j) {
    for (int32_t i = x; i < std::min(x + 4, area_.width); ++i) {
      const size_t k =
          static_cast<size_t>(j) * static_cast<size_t>(area_.width) + static_cast<size_t>(i);
      const int32_t p = prediction == nullptr ? 0 : negative ? -prediction[k] : prediction[k];
      const int32_t error = target_[k] - p;
      sum += error * error;
    }
  }
  return sum;
}

// Each reference is interpolated once: for two of them, the mean of their rounded predictions is
// near enough to decide on.
const std::array<int64_t, 16>& CellErrors::of_disparity(int32_t d) {
  for (const Known& known : known_) {
    if (known.disparity == d) return known.errors;
  }
  Known known{d, {}};
  for (size_t k = 0; k < (sets_ > 1 ? predicted_.size() : 1); ++k) interpolate_from(k, d);
  for (unsigned set = 0; set < sets_; ++set) {
    const ReferenceSet refs = references_of_set(set);
    const CellSamples* prediction = &predicted_[refs.reference[0]];
    if (refs.count == 2) {
      average(predicted_[refs.reference[0]], predicted_[refs.reference[1]]);
      prediction = &mean_;
    }
    known.errors[set] = left_by(prediction->data(), false);
    if (!sources_.keyed) known.errors[set + 8] = left_by(prediction->data(), true);
  }
  known_.push_back(known);
  return known_.back().errors;
}

void CellErrors::interpolate_from(size_t k, int32_t d) {
  const DisplacedReference part =
      displaced(*task_.references[k], area_.x, area_.y, sources_.vector(k, d, false));
  const auto width = static_cast<unsigned>(area_.width);
  interpolate_rect({part, {}}, 1, bound_,
                   {predicted_[k].data(), width, width, static_cast<unsigned>(area_.height)});
}

// Halves are rounded up and down in turn, as a bias would count against two references.
void CellErrors::average(const CellSamples& a, const CellSamples& b) {
  for (int32_t i = 0; i < area_.samples(); ++i) {
    const auto k = static_cast<size_t>(i);
    mean_[k] = static_cast<int16_t>((a[k] + b[k] + (i & 1)) >> 1);
  }
}

}  // namespace hmlfc
