#include "encoder/quality_trim.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "encoder/encode_part.hpp"

namespace hmlfc {
namespace {

// The farthest that predicted views may be from their key images.
constexpr double kFarthest = 4;
// What a step of quality takes from the logarithm of the squared errors of predicted views: little
// where hardly any residual pays, up to all that lambda says. A round at another quality, at least
// a step away, measures it.
constexpr double kUsualLogOfQuality = 0.016;
constexpr double kLeastLogOfQuality = 0.008;
constexpr double kMostLogOfQuality = 0.0866;
constexpr double kDbOfLog = 4.34;
// Where rounds end, in 32nds of the images; the first has some in any case.
constexpr std::array<size_t, 7> kEnds{3, 8, 15, 22, 27, 30, 32};
constexpr size_t kFewImages = 24;
// Key images that are farther off get another quality; after that they have to be farther off. All
// begins again at most so often.
constexpr double kFarDb = 0.2;
constexpr double kFarAgainDb = 0.3;
constexpr int kMostBegins = 6;
// Errors of key images may jump with quality, as OpenJPEG drops a bit plane: no closer is looked.
constexpr double kJump = 0.5;

// The fraction of the number's multiple of the golden section, in 2^32nds: numbers whose places
// follow each other are spread evenly.
uint32_t place_of(uint32_t number) { return number * 2654435769u; }

double eighths(double quality) { return std::round(quality * 8) / 8; }

}  // namespace

QualityTrim::QualityTrim(double quality, const LightFieldShape& shape, double db, double more_db,
                         double db_per_quality)
    : base_(quality),
      depth_(shape.depth),
      views_(size_t{shape.rows} * shape.cols),
      near_db_(more_db / 3),
      db_per_quality_(db_per_quality),
      wanted_squares_(error_of_psnr(db + near_db_, shape.depth) * 3 * shape.width * shape.height *
                      static_cast<double>(views_)),
      aim_(wanted_squares_),
      quality_(quality),
      log_of_quality_(kUsualLogOfQuality) {}

std::vector<std::vector<ImagePos>> QualityTrim::rounds(const Geometry& geometry,
                                                       std::vector<ImagePos> images) {
  std::ranges::stable_sort(images, {},
                           [&](ImagePos at) { return distance_from_references(geometry, at); });
  std::vector<uint32_t> order(images.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, place_of);
  std::vector<std::vector<ImagePos>> rounds;
  size_t at = 0;
  for (const size_t share : kEnds) {
    const size_t end =
        std::max(order.size() * share / kEnds.back(), std::min(order.size() / 2, kFewImages));
    std::vector<ImagePos>& round = rounds.emplace_back();
    for (; at < end; ++at) round.push_back(images[order[at]]);
  }
  return rounds;
}

bool QualityTrim::go_on(std::span<const uint64_t> squares) {
  if (squares.empty()) return true;
  const bool first = weight_ == 0;
  learn(squares);
  if (weight_ == 0) return true;
  if ((first || coded_ == views_) && begins_again()) return false;
  if (coded_ == views_) return true;
  const double left = std::max(1.0, aim_ - squares_) / static_cast<double>(views_ - coded_);
  const double wanted = mean_quality_ + (log_error_ - std::log(left)) / log_of_quality_;
  quality_ = eighths(std::clamp(wanted, base_ - kFarthest, base_ + kFarthest));
  return true;
}

void QualityTrim::learn(std::span<const uint64_t> squares) {
  const auto views = static_cast<double>(squares.size());
  double sum = 0;
  double of_squares = 0;
  for (const uint64_t view : squares) {
    sum += static_cast<double>(view);
    of_squares += static_cast<double>(view) * static_cast<double>(view);
  }
  if (coded_ > 0) {
    const double mean = std::max(1.0, sum) / views;
    const double log_error = std::log(mean);
    const double steps = quality_ - mean_quality_;
    if (weight_ > 0 && std::abs(steps) >= 1) {
      const double seen =
          std::clamp((log_error_ - log_error) / steps, kLeastLogOfQuality, kMostLogOfQuality);
      log_of_quality_ += (seen - log_of_quality_) * std::min(1.0, std::abs(steps) / kFarthest);
    }
    weight_ = weight_ / 2 + views;
    log_error_ += (log_error - log_error_) * (views / weight_);
    mean_quality_ += (quality_ - mean_quality_) * (views / weight_);
    spread_ = std::sqrt(std::max(0.0, of_squares / views / (mean * mean) - 1) / views);
  }
  coded_ += squares.size();
  squares_ += sum;
}

// Whether key images need another quality, or rounds have to aim elsewhere: the surplus of all
// views is too far off once all are coded, or will be if those that are left are coded like key
// images.
bool QualityTrim::begins_again() {
  const double left = static_cast<double>(views_ - coded_) *
                      std::exp(log_error_ - log_of_quality_ * (base_ - mean_quality_));
  const double all = std::max(1.0, squares_ + left);
  const QualitySurplus now{base_, 10 * std::log10(wanted_squares_ / all)};
  const double unsure_db = kDbOfLog * spread_ * left / all;
  const bool ends = coded_ == views_;
  const bool at_end = ends && std::abs(quality_ - base_) == kFarthest;
  if (ends && now.db >= -near_db_ && now.db <= 2 * near_db_) return false;
  if (!ends && std::abs(now.db) < std::max(last_ ? kFarAgainDb : kFarDb, 2 * unsure_db))
    return false;
  if (begins_ == kMostBegins) return false;
  if (ends && !at_end) {
    aim_ *= std::pow(10.0, now.db / 10);
  } else {
    (now.db < 0 ? below_ : above_) = now;
    if (last_) db_per_quality_ = db_per_quality(*last_, now);
    double next = next_quality(now, db_per_quality_, depth_);
    if (at_jump()) {
      next = above_->quality;
    } else if (below_ && above_) {
      const double share = below_->db / (below_->db - above_->db);
      next = eighths(std::lerp(below_->quality, above_->quality, std::clamp(share, 0.1, 0.9)));
    }
    if (next == base_) return false;
    last_ = now;
    base_ = quality_ = next;
    weight_ = 0;
  }
  ++begins_;
  coded_ = 0;
  squares_ = 0;
  return true;
}

bool QualityTrim::at_jump() const {
  return below_ && above_ && above_->quality - below_->quality <= kJump;
}

}  // namespace hmlfc
