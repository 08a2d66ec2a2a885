#include "encoder/coding_trial.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/view_planes.hpp"

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

// Bits of the index for a record, and for a tile with or without one.
constexpr double kRecordBits = 10;
constexpr double kTileBits = 2;

// At most `count` predictive images of the last two rows and columns of groups, which are no
// smaller than others (EXT-3), near to their references and far from them.
std::vector<ImagePos> sampled_images(const Geometry& geometry, size_t count) {
  const LevelShape& level = geometry.level(0);
  std::vector<ImagePos> last;
  for (const ImagePos at : level.all_images()) {
    const ImagePos group = geometry.group_of(0, at);
    const bool among = group.row + 2 >= level.group_rows() && group.col + 2 >= level.group_cols();
    if (among && !geometry.is_reference(0, at)) last.push_back(at);
  }
  const auto distance = [&](ImagePos at) { return distance_from_references(geometry, at); };
  std::ranges::stable_sort(last, {}, distance);
  count = std::min(count, last.size());
  std::vector<ImagePos> images;
  for (size_t i = 0; i < count; ++i)
    images.push_back(last[(2 * i + 1) * last.size() / (2 * count)]);
  return images;
}

// The sum that `all` have, if `some` of them have `sum`.
double extrapolated(double sum, double some, double all) {
  return some == 0 ? 0 : sum / some * all;
}

class Trial {
 public:
  Trial(const ViewProvider& part, const StreamHeader& header, const EncodeParams& params,
        const LightFieldProbe& probe, size_t images)
      : part_(part),
        header_(header),
        geometry_(header),
        session_(part, header, probe),
        sample_(sampled_part(geometry_, sampled_images(geometry_, images))) {
    EncodeObserver observer;
    observer.reconstructed = [&](int level, ImagePos at, const ImagePlanes& planes) {
      if (level > 0) return;
      const bool key = geometry_.is_reference(0, at);
      const ErrorSums error = view_error(part_, at, planes, header_.chroma_format);
      const std::scoped_lock lock(mutex_);
      (key ? key_error_ : error_).add(error);  // integers: threads may add in any order
      ++(key ? keys_ : predicted_);
    };
    coded_ = session_.no_images();
    session_.encode_part(params, sample_, observer, coded_);
  }

  // `scale`: pixels of a whole view to one of the part. `key_bits`: of a key image of whole views.
  TrialResult result(double scale, double key_bits) {
    const auto images = static_cast<double>(geometry_.level(0).images());
    const auto groups = static_cast<double>(geometry_.key_count());
    double bits = 0;
    double disparities = 0;
    double described = 0;  // groups with disparities
    for (const ImagePos at : geometry_.level(0).all_images()) {
      const auto number = static_cast<size_t>(geometry_.image_number(0, at));
      coded_.records.visit(number, [&](const ImageCode& image) {
        if (!geometry_.is_reference(0, at)) {
          for (const PlaneCode& plane : image) bits += bits_of(plane);
        } else if (!image[kMotionPlane].record_sizes.empty()) {
          disparities += bits_of(image[kMotionPlane]);
          ++described;
        }
      });
    }
    const auto squares = static_cast<double>(error_.rgb_squares);
    const auto key_squares = static_cast<double>(key_error_.rgb_squares);
    return {scale * (extrapolated(squares, predicted_, images - groups) +
                     extrapolated(key_squares, keys_, groups)),
            scale * (extrapolated(bits, predicted_, images - groups) +
                     extrapolated(disparities, described, groups)) +
                groups * key_bits};
  }

 private:
  static double bits_of(const PlaneCode& code) {
    double bits = 0;
    for (const uint32_t size : code.record_sizes) {
      if (size > 0) bits += 8.0 * size + kRecordBits;
    }
    return bits + kTileBits * static_cast<double>(code.record_sizes.size());
  }

  const ViewProvider& part_;
  const StreamHeader& header_;
  Geometry geometry_;
  EncodeSession session_;
  EncodePart sample_;
  CodedImages coded_;
  double predicted_ = 0;  // images
  double keys_ = 0;
  ErrorSums error_;  // of the predictive images
  ErrorSums key_error_;
  std::mutex mutex_;
};

// The bits of one key image of whole views, as the probe measured it.
double key_image_bits(const StreamHeader& header, const EncodeParams& params,
                      const LightFieldProbe& probe) {
  const PlaneTargets targets = plane_targets(header, params, probe);
  const Geometry geometry(header);
  double bits = 0;
  for (const Plane plane : kPlanes) {
    const auto p = static_cast<size_t>(plane);
    const PlaneShape& shape = geometry.plane(plane);
    const double of_sample = (params.lossless ? 1 : targets[p].key.bits) * probe.key_bits[p];
    bits += of_sample * static_cast<double>(shape.width) * shape.height;
  }
  return bits;
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

TrialResult try_coding(const LightFieldShape& whole, const ViewProvider& part,
                       const EncodeParams& params, const LightFieldProbe& probe, size_t images) {
  const auto whole_header = header_for(whole, params);
  const auto header = header_for(part.shape(), params);
  if (!header || !whole_header) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return {kInfinite, kInfinite};
  }
  const auto pixels = [](const LightFieldShape& shape) {
    return static_cast<double>(shape.width) * shape.height;
  };
  return Trial(part, *header, params, probe, images)
      .result(pixels(whole) / pixels(part.shape()), key_image_bits(*whole_header, params, probe));
}

}  // namespace hmlfc
