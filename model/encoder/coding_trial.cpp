#include "encoder/coding_trial.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <vector>

#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/view_planes.hpp"

namespace hmlfc {
namespace {

// Bits of the index for a record, and for a tile with or without one.
constexpr double kRecordBits = 10;
constexpr double kTileBits = 2;

// At most `count` predictive images of the last two rows and columns of groups, which are no
// smaller than others (EXT-3), near to their references and far from them.
std::vector<ImagePos> sampled_images(const Geometry& geometry, size_t count) {
  const LevelShape& level = geometry.level(0);
  std::vector<ImagePos> last;
  for (uint32_t r = 0; r < level.rows; ++r) {
    for (uint32_t c = 0; c < level.cols; ++c) {
      const ImagePos group = geometry.group_of(0, {r, c});
      const bool among = group.row + 2 >= level.group_rows() && group.col + 2 >= level.group_cols();
      if (among && !geometry.is_reference(0, {r, c})) last.push_back({r, c});
    }
  }
  const auto distance = [&](ImagePos at) { return distance_from_references(geometry, at); };
  std::ranges::stable_sort(last, {}, distance);
  count = std::min(count, last.size());
  std::vector<ImagePos> images;
  for (size_t i = 0; i < count; ++i)
    images.push_back(last[(2 * i + 1) * last.size() / (2 * count)]);
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
      ++(key ? keys_ : predictive_).images;
    };
    coded_ = session_.no_images();
    session_.encode_part(params, sample_, observer, coded_);
  }

  // `scale`: pixels of a whole view to one of the part. `key_bits`: of a key image of whole views.
  TrialResult result(double scale, double key_bits) {
    const auto images = static_cast<double>(geometry_.level(0).images());
    const auto groups = static_cast<double>(geometry_.key_count());
    Share disparities;
    add_bits(disparities);
    predictive_.sum.rgb_squares = static_cast<double>(error_.rgb_squares);
    keys_.sum.rgb_squares = static_cast<double>(key_error_.rgb_squares);
    const TrialResult predicted = predictive_.of_all(images - groups);
    const TrialResult shared = disparities.of_all(groups);
    return {(predicted.rgb_squares + keys_.of_all(groups).rgb_squares) * scale,
            (predicted.bits + shared.bits) * scale + groups * key_bits};
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
        const auto number = static_cast<size_t>(geometry_.image_number(0, {r, c}));
        coded_.records.visit(number, [&](const ImageCode& image) {
          if (geometry_.is_reference(0, {r, c})) {
            const PlaneCode& records = image[kMotionPlane];
            if (!records.record_sizes.empty()) disparities.add_bits(bits_of(records));
          } else {
            for (const PlaneCode& plane : image) predictive_.sum.bits += bits_of(plane);
          }
        });
      }
    }
  }

  const ViewProvider& part_;
  const StreamHeader& header_;
  Geometry geometry_;
  EncodeSession session_;
  EncodePart sample_;
  CodedImages coded_;
  Share predictive_;
  Share keys_;
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
