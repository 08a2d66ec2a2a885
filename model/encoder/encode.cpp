// One encoding, and the search for a target PSNR.
#include <hmlfc/encoder.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "bits/parallel.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"

namespace hmlfc {
namespace {

using Encoded = tl::expected<EncodedStream, EncodeError>;

Encoded refused(const char* message) { return tl::unexpected(EncodeError{message}); }

// Counts finished images and reports them, one thread at a time.
class ProgressCounter {
 public:
  // `progress` may be empty and must outlive the counter.
  ProgressCounter(const Progress& progress, uint64_t total) : progress_(progress), total_(total) {}

  void add() {
    if (!progress_) return;
    const std::scoped_lock lock(mutex_);
    done_ = std::min(done_ + 1, total_);
    progress_(done_, total_);
  }

 private:
  const Progress& progress_;
  uint64_t total_;
  uint64_t done_ = 0;
  std::mutex mutex_;
};

CodedImages encode_images(EncodeSession& session, const EncodeParams& params, bool last,
                          const Progress& progress) {
  ProgressCounter counter(progress, session.geometry().image_count());
  return session.encode(params, last, {[&] { counter.add(); }, {}});
}

// An encoding and the PSNR over RGB that it gave.
struct Attempt {
  int64_t coarseness = 0;
  double psnr_db = 0;
};

// The number that a search varies, 0 or more: PSNR falls as it grows.
class Coarseness {
 public:
  virtual ~Coarseness() = default;
  virtual int64_t first() const = 0;
  virtual int64_t coarsest() const = 0;
  // A result that exceeds the target by less is near enough.
  virtual double tolerance_db() const = 0;
  virtual void apply(int64_t coarseness, EncodeParams& params) const = 0;

  // What to try next, beyond or strictly between what was tried.
  virtual int64_t finer(const Attempt& bad, double target_db) const = 0;
  virtual int64_t coarser(const Attempt& good, double target_db) const = 0;
  virtual int64_t between(const Attempt& good, const Attempt& bad, double target_db) const = 0;
};

// Profile main: both thresholds. PSNR falls about linearly with their logarithm.
class Thresholds final : public Coarseness {
 public:
  explicit Thresholds(const MainParams& params) : first_(params.threshold_pred) {}

  int64_t first() const override { return first_; }
  // The least threshold that drops every block of every plane: 64 differences of at most 8190.
  int64_t coarsest() const override { return 64 * 8190 + 1; }
  double tolerance_db() const override { return 0.02; }

  void apply(int64_t coarseness, EncodeParams& params) const override {
    const auto threshold = static_cast<uint32_t>(coarseness);
    params.main = {threshold, threshold};
  }

  int64_t finer(const Attempt& bad, double) const override { return bad.coarseness / 4; }
  int64_t coarser(const Attempt& good, double) const override { return good.coarseness * 4 + 4; }

  int64_t between(const Attempt& good, const Attempt& bad, double target_db) const override {
    const double low = std::log2(static_cast<double>(good.coarseness) + 1);
    const double high = std::log2(static_cast<double>(bad.coarseness) + 1);
    const double share = std::isfinite(good.psnr_db)
                             ? (good.psnr_db - target_db) / (good.psnr_db - bad.psnr_db)
                             : 0.5;
    const int64_t at = std::lround(std::exp2(low + (high - low) * share) - 1);
    return std::clamp(at, good.coarseness + 1, bad.coarseness - 1);
  }

 private:
  int64_t first_;
};

// Profile extended: eighths of quality below 100. PSNR is about linear in quality.
class QualityLoss final : public Coarseness {
 public:
  explicit QualityLoss(const ExtendedParams& params)
      : first_(std::clamp<int64_t>(kMaxLoss - std::lround(params.quality * kParts), 0, kMaxLoss)) {}

  int64_t first() const override { return first_; }
  int64_t coarsest() const override { return kMaxLoss; }
  double tolerance_db() const override { return 0.02; }

  void apply(int64_t coarseness, EncodeParams& params) const override {
    params.extended.quality = static_cast<double>(kMaxLoss - coarseness) / kParts;
  }

  int64_t finer(const Attempt& bad, double target_db) const override {
    return std::max<int64_t>(0, bad.coarseness - steps(target_db - bad.psnr_db));
  }

  int64_t coarser(const Attempt& good, double target_db) const override {
    return std::min(kMaxLoss, good.coarseness + steps(good.psnr_db - target_db));
  }

  int64_t between(const Attempt& good, const Attempt& bad, double target_db) const override {
    const double share = std::isfinite(good.psnr_db)
                             ? (target_db - bad.psnr_db) / (good.psnr_db - bad.psnr_db)
                             : 0.5;
    const auto span = static_cast<double>(bad.coarseness - good.coarseness);
    const int64_t at = bad.coarseness - static_cast<int64_t>(std::ceil(share * span));
    return std::clamp(at, good.coarseness + 1, bad.coarseness - 1);
  }

 private:
  static constexpr int64_t kParts = 8;
  static constexpr int64_t kMaxLoss = 100 * kParts;
  static constexpr double kDbPerStep = 0.12 / kParts;

  // The steps that are worth `db`, at least one of quality.
  static int64_t steps(double db) {
    return std::isfinite(db) ? std::max<int64_t>(kParts, std::lround(db / kDbPerStep)) : kParts;
  }

  int64_t first_;
};

// The coarsest encoding whose PSNR reaches the target, as far as PSNR falls with coarseness.
class PsnrSearch {
 public:
  PsnrSearch(const LightFieldShape& shape, EncodeSession& session, const EncodeParams& params,
             double target_db, const Progress& progress)
      : shape_(shape),
        session_(session),
        params_(params),
        target_db_(target_db),
        progress_(progress) {
    if (params.profile == Profile::kMain) {
      axis_ = std::make_unique<Thresholds>(params.main);
    } else {
      axis_ = std::make_unique<QualityLoss>(params.extended);
    }
  }

  EncodedStream run() {
    for (int64_t next = axis_->first();; next = next_try()) {
      attempt(next);
      if (done()) break;
    }
    axis_->apply(best_coarseness_, params_);
    return {session_.stream(best_), best_.error, params_};
  }

 private:
  bool done() const {
    if (bad_ && bad_->coarseness == 0) return true;
    if (!good_) return false;
    if (good_->psnr_db < target_db_ + axis_->tolerance_db()) return true;
    if (good_->coarseness >= axis_->coarsest()) return true;
    return bad_ && bad_->coarseness - good_->coarseness <= 1;
  }

  int64_t next_try() const {
    if (!good_) return axis_->finer(*bad_, target_db_);
    if (!bad_) return axis_->coarser(*good_, target_db_);
    return axis_->between(*good_, *bad_, target_db_);
  }

  void attempt(int64_t coarseness) {
    EncodeParams params = params_;
    axis_->apply(coarseness, params);
    CodedImages images = encode_images(session_, params, false, progress_);
    const uint64_t samples = uint64_t{shape_.rows} * shape_.cols * shape_.width * shape_.height * 3;
    const Attempt result{coarseness, psnr(images.error.rgb_squares, samples, shape_.depth)};
    const bool good = result.psnr_db >= target_db_;
    (good ? good_ : bad_) = result;
    if (good || coarseness == 0) {
      best_ = std::move(images);
      best_coarseness_ = coarseness;
    }
  }

  LightFieldShape shape_;
  EncodeSession& session_;
  EncodeParams params_;
  double target_db_;
  const Progress& progress_;
  std::unique_ptr<Coarseness> axis_;
  std::optional<Attempt> good_;
  std::optional<Attempt> bad_;
  CodedImages best_;
  int64_t best_coarseness_ = 0;
};

// Whether what trials may settle is open or in its interval.
bool has_known_extended_choices(const ExtendedParams& params) {
  const auto one_of = [](unsigned value, unsigned a, unsigned b) {
    return value == 0 || value == a || value == b;
  };
  return one_of(params.disparity_grid, 4, 8) && one_of(params.motion_tile, 64, 128) &&
         (params.key_weight == 0 || (params.key_weight >= 0.25 && params.key_weight <= 4));
}

// Checks and settles `params`, then calls body(session, settled params) on their threads.
template <class Body>
Encoded run_encoder(const LightField& light_field, const EncodeParams& params,
                    std::optional<double> target_db, const Body& body) {
  constexpr const char* kOutside =
      "an encoding parameter is outside its interval (see hmlfc encode --help)";
  const EncodeParams complete = with_defaults(params);
  EncodeParams checked = complete;  // what is left to a trial passes any check
  checked.ref_rows = std::max(1u, complete.ref_rows);
  checked.ref_cols = std::max(1u, complete.ref_cols);
  checked.chroma = complete.chroma.value_or(ChromaFormat::k420);
  if (!(params.extended.quality >= 0 && params.extended.quality <= 100)) {
    return refused("the quality is outside [0, 100]");
  }
  if (!has_known_extended_choices(params.extended)) return refused(kOutside);
  if (!header_for(light_field.shape(), checked)) return refused(kOutside);
  try {
    Encoded encoded;
    run_on_threads(params.threads, [&] {
      const SettledCoding settled = settle_coding(light_field, complete, target_db);
      const auto header = header_for(light_field.shape(), settled.params);
      if (!header) {
        encoded = refused(kOutside);
        return;
      }
      EncodeSession session(light_field, *header, settled.probe);
      encoded = body(session, settled.params);
    });
    return encoded;
  } catch (const std::bad_alloc&) {
    return refused("out of memory: encode fewer or smaller views, or free some memory");
  }
}

}  // namespace

Encoded encode(const LightField& light_field, const EncodeParams& params,
               const Progress& progress) {
  return run_encoder(light_field, params, std::nullopt,
                     [&](EncodeSession& session, const EncodeParams& settled) {
                       CodedImages images = encode_images(session, settled, true, progress);
                       return EncodedStream{session.stream(images), images.error, settled};
                     });
}

Encoded encode_to_psnr(const LightField& light_field, const EncodeParams& params, double target_db,
                       const Progress& progress) {
  if (!(target_db >= 1 && target_db <= 100)) {
    return refused("the target PSNR must lie in [1, 100] dB");
  }
  EncodeParams lossy = params;
  lossy.lossless = false;
  return run_encoder(
      light_field, lossy, target_db, [&](EncodeSession& session, const EncodeParams& settled) {
        return PsnrSearch(light_field.shape(), session, settled, target_db, progress).run();
      });
}

}  // namespace hmlfc
