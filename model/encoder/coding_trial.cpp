#include "encoder/coding_trial.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/motion_prediction.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/view_planes.hpp"

namespace hmlfc {
namespace {

constexpr uint32_t kTrialWidth = 384;
constexpr uint32_t kTrialHeight = 256;
// What a squared error of Y, Co and Cg is in R, G and B together.
constexpr std::array<double, kPlaneCount> kRgbSquares{3, 0.5, 0.75};
// Bits of the index for a record, and for a tile with or without one.
constexpr double kRecordBits = 10;
constexpr double kTileBits = 2;

// How far an image is from its reference, in views.
uint32_t distance(ImagePos at, ImagePos reference) {
  return static_cast<uint32_t>(std::abs(row_offset(reference, at)) +
                               std::abs(col_offset(reference, at)));
}

// At most `count` predictive images of the first two rows and columns of groups, as near to and as
// far from their references as images of the whole grid are: the first groups may be larger.
std::vector<ImagePos> spread_images(const Geometry& geometry, size_t count) {
  const LevelShape& level = geometry.level(0);
  std::vector<ImagePos> first;
  std::vector<uint32_t> all;
  const auto distance_of = [&](ImagePos at) { return distance(at, geometry.reference_of(0, at)); };
  for (uint32_t r = 0; r < level.rows; ++r) {
    for (uint32_t c = 0; c < level.cols; ++c) {
      if (geometry.is_reference(0, {r, c})) continue;
      all.push_back(distance_of({r, c}));
      const ImagePos group = geometry.group_of(0, {r, c});
      if (group.row <= 1 && group.col <= 1) first.push_back({r, c});
    }
  }
  std::sort(all.begin(), all.end());
  std::stable_sort(first.begin(), first.end(),
                   [&](ImagePos a, ImagePos b) { return distance_of(a) < distance_of(b); });
  std::vector<ImagePos> images;
  for (const uint32_t wanted : evenly_spread(all, count)) {
    if (first.empty()) break;
    // Of those at the nearest distance the one in the middle: others are next to it.
    const auto apart = [&](ImagePos at) {
      return std::abs(static_cast<int32_t>(distance_of(at)) - static_cast<int32_t>(wanted));
    };
    const auto nearest = std::min_element(
        first.begin(), first.end(), [&](ImagePos a, ImagePos b) { return apart(a) < apart(b); });
    const auto end = std::find_if(nearest, first.end(), [&](ImagePos at) {
      return distance_of(at) != distance_of(*nearest);
    });
    const auto chosen = nearest + (end - nearest) / 2;
    images.push_back(*chosen);
    first.erase(chosen);
  }
  return images;
}

// Sums over the images that a trial codes.
struct Share {
  TrialResult sum;
  double images = 0;

  void add_bits(double bits) {
    sum.bits += bits;
    ++images;
  }

  // The sums that `all` images would have.
  TrialResult of_all(double all) const {
    if (images == 0) return {};
    return {sum.rgb_squares / images * all, sum.bits / images * all};
  }
};

class Trial {
 public:
  Trial(const LightField& part, const StreamHeader& header, const EncodeParams& params,
        const LightFieldProbe& probe, size_t images)
      : part_(part),
        header_(header),
        geometry_(header),
        session_(part, header, probe),
        sample_(spread_images(geometry_, images)) {
    EncodeObserver observer;
    observer.reconstructed = [&](int level, ImagePos at, const ImagePlanes& planes) {
      if (level > 0 || geometry_.is_reference(0, at)) return;
      const ErrorSums error = view_error(part_, at, planes, header_.chroma_format);
      const std::scoped_lock lock(mutex_);
      error_.add(error);  // integers: threads may add in any order
      ++predictive_.images;
    };
    coded_ = session_.encode(params, true, observer, &sample_);
  }

  // `scale`: pixels of a whole view to one of the part. The key images are those of whole views.
  TrialResult result(double scale, const TrialResult& keys) {
    const auto images = static_cast<double>(geometry_.level(0).images());
    const auto groups = static_cast<double>(geometry_.key_count());
    Share disparities;
    add_bits(disparities);
    predictive_.sum.rgb_squares = static_cast<double>(error_.rgb_squares);
    const TrialResult predicted = predictive_.of_all(images - groups);
    const TrialResult shared = disparities.of_all(groups);
    return {predicted.rgb_squares * scale + groups * keys.rgb_squares,
            (predicted.bits + shared.bits) * scale + groups * keys.bits};
  }

 private:
  static double bits_of(const PlaneCode& code) {
    double bits = 0;
    for (const uint32_t size : code.record_sizes) {
      if (size > 0) bits += 8.0 * size + kRecordBits;
    }
    return bits + kTileBits * static_cast<double>(code.record_sizes.size());
  }

  void add_bits(Share& disparities) {
    for (uint32_t r = 0; r < header_.rows; ++r) {
      for (uint32_t c = 0; c < header_.cols; ++c) {
        const ImageCode& image =
            coded_.codes[static_cast<size_t>(geometry_.image_number(0, {r, c}))];
        if (geometry_.is_reference(0, {r, c})) {
          const PlaneCode& records = image[kMotionPlane];
          if (!records.record_sizes.empty()) disparities.add_bits(bits_of(records));
        } else {
          for (const PlaneCode& plane : image) predictive_.sum.bits += bits_of(plane);
        }
      }
    }
  }

  const LightField& part_;
  const StreamHeader& header_;
  Geometry geometry_;
  EncodeSession session_;
  std::vector<ImagePos> sample_;
  CodedImages coded_;
  Share predictive_;
  ErrorSums error_;  // of the predictive images
  std::mutex mutex_;
};

// How much there is to code in each cell of 16x16 pixels of a view: log2 of its variance, row by
// row.
class Activity {
 public:
  explicit Activity(const SamplePlane& luma)
      : columns_(luma.width / kCell), rows_(luma.height / kCell) {
    for (uint32_t y = 0; y < rows_; ++y) {
      for (uint32_t x = 0; x < columns_; ++x) cells_.push_back(of_cell(luma, x, y));
    }
  }

  static constexpr uint32_t kCell = 16;
  uint32_t columns() const { return columns_; }
  uint32_t rows() const { return rows_; }

  // How far `columns` x `rows` cells from (x, y) on differ from the whole, in the shares of cells
  // with more than each of some activities.
  double difference(uint32_t x, uint32_t y, uint32_t columns, uint32_t rows) const {
    double sum = 0;
    for (int bound = 1; bound <= 13; ++bound) {
      sum += std::abs(share(bound, x, y, columns, rows) - share(bound, 0, 0, columns_, rows_));
    }
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

  double share(int bound, uint32_t x, uint32_t y, uint32_t columns, uint32_t rows) const {
    uint32_t above = 0;
    for (uint32_t j = y; j < y + rows; ++j) {
      for (uint32_t i = x; i < x + columns; ++i)
        above += cells_[j * columns_ + i] >= bound ? 1u : 0u;
    }
    return static_cast<double>(above) / (static_cast<double>(columns) * rows);
  }

  uint32_t columns_;
  uint32_t rows_;
  std::vector<int> cells_;
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

// One key image of whole views, as the probe measured it.
TrialResult key_image(const StreamHeader& header, const EncodeParams& params,
                      const LightFieldProbe& probe) {
  const PlaneTargets targets = plane_targets(header, params, probe);
  const Geometry geometry(header);
  const double pixels = static_cast<double>(header.width) * header.height;
  TrialResult key;
  for (const Plane plane : kPlanes) {
    const auto p = static_cast<size_t>(plane);
    const PlaneShape& shape = geometry.plane(plane);
    key.rgb_squares += kRgbSquares[p] * targets[p].key.error * pixels;
    key.bits += targets[p].key.bits * static_cast<double>(shape.width) * shape.height;
  }
  return key;
}

}  // namespace

LightField trial_part(const LightField& light_field, const StreamHeader& header) {
  const LightFieldShape whole = light_field.shape();
  LightFieldShape shape = whole;
  shape.width = std::min(whole.width, kTrialWidth);
  shape.height = std::min(whole.height, kTrialHeight);
  const ImagePos middle{whole.rows / 2, whole.cols / 2};
  const auto place = typical_place(view_planes(light_field, Geometry(header), middle)[0], shape);
  // The plane is that of whole blocks, which may be larger than the view.
  const uint32_t x = std::min(place.first, whole.width - shape.width);
  const uint32_t y = std::min(place.second, whole.height - shape.height);
  LightField part(shape);
  std::vector<uint16_t> pixels(size_t{whole.width} * 3);
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      for (uint32_t j = 0; j < shape.height; ++j) {
        light_field.read_row(row, col, y + j, pixels);
        part.write_row(row, col, j,
                       std::span(pixels).subspan(size_t{x} * 3, size_t{shape.width} * 3));
      }
    }
  }
  return part;
}

TrialResult try_coding(const LightField& light_field, const LightField& part,
                       const EncodeParams& params, const LightFieldProbe& probe, size_t images) {
  const auto whole = header_for(light_field.shape(), params);
  const auto header = header_for(part.shape(), params);
  if (!header || !whole) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return {kInfinite, kInfinite};
  }
  const auto pixels = [](const LightFieldShape& shape) {
    return static_cast<double>(shape.width) * shape.height;
  };
  return Trial(part, *header, params, probe, images)
      .result(pixels(light_field.shape()) / pixels(part.shape()), key_image(*whole, params, probe));
}

}  // namespace hmlfc
