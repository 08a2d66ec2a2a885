// The search for the thresholds of a target PSNR.
#include <hmlfc/encoder.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include "encoder/encode_run.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/quality_search.hpp"

namespace hmlfc {
namespace {

// A result this little above the target is near enough.
constexpr double kToleranceDb = 0.02;

// The least threshold that drops every block of every plane: 64 differences of at most 8190.
constexpr uint32_t kDropAll = 64 * 8190 + 1;

// One try: thresholds and the PSNR they gave.
struct Try {
  uint32_t threshold = 0;
  double psnr_db = 0;
};

// PSNR falls about linearly with the logarithm of the threshold.
double scale_of(uint32_t threshold) { return std::log2(static_cast<double>(threshold) + 1); }

// A threshold strictly between two tries, where the line through them meets the target.
uint32_t between(const Try& good, const Try& bad, double target_db) {
  const double low = scale_of(good.threshold);
  const double high = scale_of(bad.threshold);
  double share = 0.5;
  if (std::isfinite(good.psnr_db) && good.psnr_db > bad.psnr_db) {
    share = (good.psnr_db - target_db) / (good.psnr_db - bad.psnr_db);
  }
  const double at = std::exp2(low + (high - low) * share) - 1;
  const auto threshold = static_cast<uint32_t>(std::lround(at));
  return std::clamp(threshold, good.threshold + 1, bad.threshold - 1);
}

class ThresholdSearch {
 public:
  ThresholdSearch(const LightField& light_field, const StreamHeader& header,
                  const EncodeParams& params, double target_db, const Progress& progress)
      : shape_(light_field.shape()),
        session_(light_field, header, params),
        params_(params),
        target_db_(target_db),
        progress_(progress) {}

  EncodedStream run() {
    uint32_t next = params_.threshold_pred;
    while (!done()) {
      attempt(next);
      if (!good_) {
        next = bad_->threshold / 4;
      } else if (!bad_) {
        next = good_->threshold * 4 + 4;
      } else if (bad_->threshold > good_->threshold + 1) {
        next = between(*good_, *bad_, target_db_);
      }
    }
    EncodeParams params = params_;
    params.threshold_ref = best_threshold_;
    params.threshold_pred = best_threshold_;
    return {session_.stream(best_), best_.error, params};
  }

 private:
  bool done() const {
    if (bad_ && bad_->threshold == 0) return true;
    if (!good_) return false;
    if (good_->psnr_db < target_db_ + kToleranceDb) return true;
    if (good_->threshold >= kDropAll) return true;
    return bad_ && bad_->threshold == good_->threshold + 1;
  }

  void attempt(uint32_t threshold) {
    ProgressCounter counter(progress_, session_.geometry().image_count());
    CodedImages images = session_.encode(threshold, threshold, false, {[&] { counter.add(); }, {}});
    const uint64_t samples = uint64_t{shape_.rows} * shape_.cols * shape_.width * shape_.height * 3;
    const Try result{threshold, psnr(images.error.rgb_squares, samples, shape_.depth)};
    const bool good = result.psnr_db >= target_db_;
    if (good) {
      good_ = result;
    } else {
      bad_ = result;
    }
    if (good || threshold == 0) {
      best_ = std::move(images);
      best_threshold_ = threshold;
    }
  }

  LightFieldShape shape_;
  EncodeSession session_;
  EncodeParams params_;
  double target_db_;
  const Progress& progress_;
  std::optional<Try> good_;
  std::optional<Try> bad_;
  CodedImages best_;
  uint32_t best_threshold_ = 0;
};

}  // namespace

tl::expected<EncodedStream, EncodeError> encode_to_psnr(const LightField& light_field,
                                                        const EncodeParams& params,
                                                        double target_db,
                                                        const Progress& progress) {
  if (!(target_db >= 1 && target_db <= 100)) {
    return tl::unexpected(EncodeError{"the target PSNR must lie in [1, 100] dB"});
  }
  if (auto ok = check_params(light_field.shape(), params); !ok) {
    return tl::unexpected(ok.error());
  }
  return run_encoder(params.threads, [&]() -> tl::expected<EncodedStream, EncodeError> {
    if (params.profile == Profile::kExtended) {
      return search_quality(light_field, params, target_db, progress);
    }
    const auto header = checked_header(light_field.shape(), params);
    if (!header) return tl::unexpected(header.error());
    return ThresholdSearch(light_field, *header, params, target_db, progress).run();
  });
}

}  // namespace hmlfc
