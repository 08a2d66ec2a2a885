#include "encoder/trial_part.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

constexpr uint32_t kTrialWidth = 384;
constexpr uint32_t kTrialHeight = 256;

// How much there is to code in each cell of 16x16 pixels of a view: log2 of its variance, row by
// row.
class Activity {
 public:
  explicit Activity(const SamplePlane& luma)
      : columns_(luma.width / kCell), rows_(luma.height / kCell) {
    for (uint32_t y = 0; y < rows_; ++y) {
      for (uint32_t x = 0; x < columns_; ++x) cells_.push_back(of_cell(luma, x, y));
    }
    whole_ = shares(0, 0, columns_, rows_);
  }

  static constexpr uint32_t kCell = 16;
  uint32_t columns() const { return columns_; }
  uint32_t rows() const { return rows_; }

  // How far `columns` x `rows` cells from (x, y) on differ from the whole.
  double difference(uint32_t x, uint32_t y, uint32_t columns, uint32_t rows) const {
    const Shares part = shares(x, y, columns, rows);
    double sum = 0;
    for (size_t i = 0; i < part.size(); ++i) sum += std::abs(part[i] - whole_[i]);
    return sum;
  }

 private:
  static int of_cell(const SamplePlane& luma, uint32_t x, uint32_t y) {
    int64_t sum = 0;
    int64_t squares = 0;
    for (uint32_t j = 0; j < kCell; ++j) {
      for (uint32_t i = 0; i < kCell; ++i) {
        const int64_t sample = luma.at(x * kCell + i, y * kCell + j);
        sum += sample;
        squares += sample * sample;
      }
    }
    constexpr int64_t kSamples = int64_t{kCell} * kCell;
    return static_cast<int>(
        std::bit_width(static_cast<uint64_t>((squares - sum * sum / kSamples) / kSamples)));
  }

  // Of cells with an activity of more than 0, 1 and so on.
  using Shares = std::array<double, 13>;

  Shares shares(uint32_t x, uint32_t y, uint32_t columns, uint32_t rows) const {
    std::array<uint32_t, std::tuple_size_v<Shares> + 1> counts{};
    for (uint32_t j = y; j < y + rows; ++j) {
      for (uint32_t i = x; i < x + columns; ++i) {
        ++counts[std::min(static_cast<size_t>(cells_[j * columns_ + i]), counts.size() - 1)];
      }
    }
    Shares shares{};
    uint32_t above = 0;
    for (size_t i = shares.size(); i-- > 0;) {
      above += counts[i + 1];
      shares[i] = static_cast<double>(above) / (static_cast<double>(columns) * rows);
    }
    return shares;
  }

  uint32_t columns_;
  uint32_t rows_;
  std::vector<int> cells_;
  Shares whole_{};
};

// The place of a part of `shape`'s size that is most like the whole of `luma`.
std::pair<uint32_t, uint32_t> typical_place(const SamplePlane& luma, const LightFieldShape& shape) {
  const Activity activity(luma);
  const uint32_t columns = std::max(1u, shape.width / Activity::kCell);
  const uint32_t rows = std::max(1u, shape.height / Activity::kCell);
  std::pair<uint32_t, uint32_t> best{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t y = 0; y + rows <= activity.rows(); ++y) {
    for (uint32_t x = 0; x + columns <= activity.columns(); ++x) {
      const double difference = activity.difference(x, y, columns, rows);
      if (difference >= least) continue;
      least = difference;
      best = {x * Activity::kCell, y * Activity::kCell};
    }
  }
  return best;
}

}  // namespace

Rect trial_part(const ViewProvider& views, const StreamHeader& header) {
  const LightFieldShape& whole = views.shape();
  LightFieldShape shape = whole;
  shape.width = std::min(whole.width, kTrialWidth);
  shape.height = std::min(whole.height, kTrialHeight);
  const ImagePos middle{whole.rows / 2, whole.cols / 2};
  const auto place = typical_place(view_planes(views, Geometry(header), middle)[0], shape);
  // The plane is that of whole blocks, which may be larger than the view.
  return {std::min(place.first, whole.width - shape.width),
          std::min(place.second, whole.height - shape.height), shape.width, shape.height};
}

}  // namespace hmlfc
