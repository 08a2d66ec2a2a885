#include "encoder/quality_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "encoder/coding_choice.hpp"
#include "encoder/encode_run.hpp"
#include "encoder/extended_session.hpp"

namespace hmlfc {
namespace {

// Qualities are tried in quarters.
constexpr int kParts = 4;
constexpr int kMostQuality = 100 * kParts;
// A result this little above the target is near enough.
constexpr double kToleranceDb = 0.03;
// PSNR rises by about this much for one step of quality.
constexpr double kDbAStep = 0.12 / kParts;

struct Try {
  int quality = 0;
  double psnr_db = 0;
};

class QualitySearch {
 public:
  QualitySearch(const LightField& light_field, const StreamHeader& header,
                const EncodeParams& params, double target_db, const Progress& progress)
      : light_field_(light_field),
        header_(header),
        params_(params),
        target_db_(target_db),
        progress_(progress) {}

  EncodedStream run() {
    int next = static_cast<int>(std::lround(params_.quality * kParts));
    do {
      attempt(std::clamp(next, 0, kMostQuality));
      next = next_quality();
    } while (!done());
    return std::move(best_);
  }

 private:
  bool done() const {
    if (good_ && good_->psnr_db < target_db_ + kToleranceDb) return true;
    if (good_ && good_->quality == 0) return true;
    if (bad_ && bad_->quality == kMostQuality) return true;
    return good_ && bad_ && good_->quality - bad_->quality <= 1;
  }

  // Between the tries on both sides of the target, else beyond the one there is.
  int next_quality() const {
    const auto steps = [](double db) { return static_cast<int>(std::lround(db / kDbAStep)); };
    if (!good_) return bad_->quality + std::max(kParts, steps(target_db_ - bad_->psnr_db));
    if (!bad_) return good_->quality - std::max(kParts, steps(good_->psnr_db - target_db_));
    const double share = std::isfinite(good_->psnr_db)
                             ? (target_db_ - bad_->psnr_db) / (good_->psnr_db - bad_->psnr_db)
                             : 0.5;
    const int span = good_->quality - bad_->quality;
    const int at = bad_->quality + static_cast<int>(std::ceil(share * span));
    return std::clamp(at, bad_->quality + 1, std::max(good_->quality - 1, bad_->quality + 1));
  }

  void attempt(int quality) {
    EncodeParams params = params_;
    params.quality = static_cast<double>(quality) / kParts;
    ProgressCounter counter(progress_, Geometry(header_).image_count());
    ExtendedStream stream =
        encode_extended(light_field_, header_, params, {[&] { counter.add(); }, {}});
    const LightFieldShape& shape = light_field_.shape();
    const uint64_t samples = uint64_t{shape.rows} * shape.cols * shape.width * shape.height * 3;
    const Try result{quality, psnr(stream.error.rgb_squares, samples, shape.depth)};
    const bool good = result.psnr_db >= target_db_;
    (good ? good_ : bad_) = result;
    if (good || quality == kMostQuality) {
      best_ = {assemble_extended(stream), stream.error, params};
    }
  }

  const LightField& light_field_;
  const StreamHeader& header_;
  const EncodeParams& params_;
  double target_db_;
  const Progress& progress_;
  std::optional<Try> good_;
  std::optional<Try> bad_;
  EncodedStream best_;
};

}  // namespace

tl::expected<EncodedStream, EncodeError> search_quality(const LightField& light_field,
                                                        const EncodeParams& params,
                                                        double target_db,
                                                        const Progress& progress) {
  const EncodeParams settled = settle_coding(light_field, params, target_db);
  const auto header = checked_header(light_field.shape(), settled);
  if (!header) return tl::unexpected(header.error());
  return QualitySearch(light_field, *header, settled, target_db, progress).run();
}

}  // namespace hmlfc
