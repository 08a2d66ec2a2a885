#include "encoder/coding_trial.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <vector>

#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/view_planes.hpp"

namespace hmlfc {
namespace {

// Views up to this size are tried whole, of larger ones two parts on the diagonal: what is hard to
// predict often lies on one side.
constexpr uint32_t kWholeWidth = 384;
constexpr uint32_t kWholeHeight = 256;
constexpr uint32_t kPartWidth = 256;
constexpr uint32_t kPartHeight = 192;

std::vector<Rect> tried_parts(const LightFieldShape& shape) {
  if (shape.width <= kWholeWidth && shape.height <= kWholeHeight) {
    return {{0, 0, shape.width, shape.height}};
  }
  const uint32_t width = std::min(shape.width, kPartWidth);
  const uint32_t height = std::min(shape.height, kPartHeight);
  // With their middles at a quarter and at three quarters, where that leaves them inside.
  const uint32_t x = std::max(shape.width / 4, width / 2) - width / 2;
  const uint32_t y = std::max(shape.height / 4, height / 2) - height / 2;
  return {{x, y, width, height},
          {shape.width - width - x, shape.height - height - y, width, height}};
}

// Bits of the index for a record, and for a tile with or without one.
constexpr double kRecordBits = 10;
constexpr double kTileBits = 2;

// At most `count` predictive images of the last two rows and columns of groups, which are no
// smaller than others (EXT-3), near to their references and far from them. They refer to key images
// of these groups alone, so that few are coded.
std::vector<ImagePos> sampled_images(const Geometry& geometry, size_t count) {
  const LevelShape& level = geometry.level(0);
  const auto is_last = [&](ImagePos at) {
    const ImagePos group = geometry.group_of(0, at);
    return group.row + 2 >= level.group_rows() && group.col + 2 >= level.group_cols();
  };
  std::vector<ImagePos> last;
  for (const ImagePos at : level.all_images()) {
    if (geometry.is_reference(0, at) || !is_last(at)) continue;
    if (std::ranges::all_of(reference_images(geometry, 0, at), is_last)) last.push_back(at);
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
      if (key) key_seconds_ = seconds();
    };
    coded_ = session_.no_images();
    session_.encode_part(params, sample_, observer, coded_);
    seconds_ = seconds();
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
                groups * key_bits,
            scale * (extrapolated(seconds_ - key_seconds_, predicted_, images - groups) +
                     extrapolated(key_seconds_, keys_, groups))};
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

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
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double key_seconds_ = 0;  // until the last key image was coded
  double seconds_ = 0;
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

TrialParts trial_parts(const ViewProvider& views, uint64_t max_bytes) {
  const std::vector<Rect> rects = tried_parts(views.shape());
  TrialParts parts;
  for (const Rect& rect : rects) parts.emplace_back(views, rect, max_bytes / rects.size());
  return parts;
}

TrialResult try_coding(const LightFieldShape& whole, const TrialParts& parts,
                       const EncodeParams& params, const LightFieldProbe& probe, size_t images) {
  const LightFieldShape& tried = parts.front().shape();
  const auto whole_header = header_for(whole, params);
  const auto header = header_for(tried, params);
  if (!header || !whole_header) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return {kInfinite, kInfinite, 0};
  }
  const auto pixels = [](const LightFieldShape& shape) {
    return static_cast<double>(shape.width) * shape.height;
  };
  const double share = 1 / static_cast<double>(parts.size());
  const double scale = share * pixels(whole) / pixels(tried);
  const double key_bits = share * key_image_bits(*whole_header, params, probe);
  TrialResult sum;
  for (const CachedViews& part : parts) {
    const TrialResult result = Trial(part, *header, params, probe, images).result(scale, key_bits);
    sum.rgb_squares += result.rgb_squares;
    sum.bits += result.bits;
    sum.seconds += result.seconds;
  }
  return sum;
}

}  // namespace hmlfc
