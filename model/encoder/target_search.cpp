#include "encoder/target_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace hmlfc {
namespace {

// A coarseness that was tried and what it exceeds the target by.
struct Attempt {
  int64_t coarseness = 0;
  double surplus_db = 0;
};

// Where `surplus_db` is 0 between the two, as a share of the way from `coarse` to `fine`.
double share_to(const Attempt& fine, const Attempt& coarse) {
  if (!std::isfinite(fine.surplus_db)) return 0.5;
  return -coarse.surplus_db / (fine.surplus_db - coarse.surplus_db);
}

// The number that a search varies, 0 or more: PSNR and bytes fall as it grows.
class Coarseness {
 public:
  virtual ~Coarseness() = default;
  virtual int64_t of(const EncodeParams& params) const = 0;
  virtual int64_t coarsest() const = 0;
  virtual void apply(int64_t coarseness, EncodeParams& params) const = 0;

  // What to try next, beyond or strictly between what was tried.
  virtual int64_t finer(const Attempt& coarse) const = 0;
  virtual int64_t coarser(const Attempt& fine) const = 0;
  virtual int64_t between(const Attempt& fine, const Attempt& coarse) const = 0;
};

// Profile main: both thresholds. PSNR falls about linearly with their logarithm.
class Thresholds final : public Coarseness {
 public:
  int64_t of(const EncodeParams& params) const override { return params.main.threshold_pred; }
  // The least threshold that drops every block of every plane: 64 differences of at most 8190.
  int64_t coarsest() const override { return 64 * 8190 + 1; }

  void apply(int64_t coarseness, EncodeParams& params) const override {
    params.main.threshold_ref = params.main.threshold_pred = static_cast<uint32_t>(coarseness);
  }

  int64_t finer(const Attempt& coarse) const override { return coarse.coarseness / 4; }
  int64_t coarser(const Attempt& fine) const override {
    return std::min(coarsest(), fine.coarseness * 4 + 4);
  }

  int64_t between(const Attempt& fine, const Attempt& coarse) const override {
    const double low = std::log2(static_cast<double>(fine.coarseness) + 1);
    const double high = std::log2(static_cast<double>(coarse.coarseness) + 1);
    const double share = 1 - share_to(fine, coarse);
    const int64_t at = std::lround(std::exp2(low + (high - low) * share) - 1);
    return std::clamp(at, fine.coarseness + 1, coarse.coarseness - 1);
  }
};

// Profile extended: eighths of quality below the highest. PSNR is about linear in quality.
class QualityLoss final : public Coarseness {
 public:
  explicit QualityLoss(int depth)
      : coarsest_(std::lround((kHighestQuality - lowest_quality(depth)) * kParts)) {}

  int64_t of(const EncodeParams& params) const override {
    return std::clamp<int64_t>(std::lround((kHighestQuality - params.extended.quality) * kParts), 0,
                               coarsest_);
  }
  int64_t coarsest() const override { return coarsest_; }

  void apply(int64_t coarseness, EncodeParams& params) const override {
    params.extended.quality = kHighestQuality - static_cast<double>(coarseness) / kParts;
  }

  int64_t finer(const Attempt& coarse) const override {
    return std::max<int64_t>(0, coarse.coarseness - steps(-coarse.surplus_db));
  }

  int64_t coarser(const Attempt& fine) const override {
    return std::min(coarsest_, fine.coarseness + steps(fine.surplus_db));
  }

  int64_t between(const Attempt& fine, const Attempt& coarse) const override {
    const auto span = static_cast<double>(coarse.coarseness - fine.coarseness);
    const int64_t at =
        coarse.coarseness - static_cast<int64_t>(std::ceil(share_to(fine, coarse) * span));
    return std::clamp(at, fine.coarseness + 1, coarse.coarseness - 1);
  }

 private:
  static constexpr int64_t kParts = 8;
  static constexpr double kDbPerStep = kDbPerQuality / kParts;

  // The steps that are worth `db`, at least one.
  static int64_t steps(double db) {
    return std::isfinite(db) ? std::max<int64_t>(1, std::lround(db / kDbPerStep)) : kParts;
  }

  int64_t coarsest_;
};

std::unique_ptr<Coarseness> coarseness_of(const EncodeParams& params, int depth) {
  if (params.profile == Profile::kMain) return std::make_unique<Thresholds>();
  return std::make_unique<QualityLoss>(depth);
}

class TargetSearch {
 public:
  TargetSearch(const LightFieldShape& shape, const EncodeParams& params, const EncodeGoal& goal,
               const EncodeAttempt& attempt)
      : shape_(shape),
        params_(params),
        goal_(goal),
        encode_(attempt),
        axis_(coarseness_of(params, shape.depth)) {}

  EncodedStream run() {
    for (int64_t next = axis_->of(params_);; next = next_try()) {
      attempt(next);
      if (done()) return std::move(best_);
    }
  }

 private:
  bool done() const {
    if (!fine_) return is_near(*coarse_) || coarse_->coarseness == 0;
    if (!coarse_) return is_near(*fine_) || fine_->coarseness >= axis_->coarsest();
    if (is_near(goal_.is_least() ? *fine_ : *coarse_)) return true;
    return coarse_->coarseness - fine_->coarseness <= 1;
  }

  // Where PSNR moves in large steps, a search would go on for little.
  bool is_near(const Attempt& attempt) const {
    return goal_.is_near(attempt.surplus_db, goal_.is_least() ? 1 + attempts_ / 4 : 1);
  }

  // Aims at the middle of what is near enough.
  int64_t next_try() {
    const double aim = (goal_.is_least() ? 0.5 : -0.5) * goal_.tolerance_db();
    const auto off = [&](const Attempt& attempt, double times) {
      return Attempt{attempt.coarseness, (attempt.surplus_db - aim) * times};
    };
    const double times = 1 << std::min(times_in_row_ - 1, 10);
    // On noise, PSNR hardly moves with quality: the search goes ever farther.
    if (!fine_) return axis_->finer(off(*coarse_, times));
    if (!coarse_) return axis_->coarser(off(*fine_, times));
    // What was tried long ago counts for less, or the other end would move on in small steps.
    return axis_->between(off(*fine_, last_is_fine_ ? 1 : 1 / times),
                          off(*coarse_, last_is_fine_ ? 1 / times : 1));
  }

  void attempt(int64_t coarseness) {
    EncodeParams params = params_;
    axis_->apply(coarseness, params);
    EncodedStream stream = encode_(params);
    const double surplus = goal_.surplus_db(stream, shape_);
    const bool met = goal_.is_met(surplus);
    const bool is_fine = met == goal_.is_least();
    (is_fine ? fine_ : coarse_) = Attempt{coarseness, surplus};
    ++attempts_;
    times_in_row_ = is_fine == last_is_fine_ ? times_in_row_ + 1 : 1;
    last_is_fine_ = is_fine;
    if (met || !any_met_) best_ = std::move(stream);
    any_met_ = any_met_ || met;
  }

  LightFieldShape shape_;
  EncodeParams params_;
  const EncodeGoal& goal_;
  const EncodeAttempt& encode_;
  std::unique_ptr<Coarseness> axis_;
  std::optional<Attempt> fine_;    // at or beyond the target, the coarsest so far
  std::optional<Attempt> coarse_;  // the finest so far that is not
  EncodedStream best_;             // the last that meets the target, else the last
  bool any_met_ = false;
  int attempts_ = 0;
  bool last_is_fine_ = false;
  int times_in_row_ = 0;  // that attempts ended there
};

}  // namespace

EncodedStream search_target(const LightFieldShape& shape, const EncodeParams& params,
                            const EncodeGoal& goal, const EncodeAttempt& attempt) {
  return TargetSearch(shape, params, goal, attempt).run();
}

}  // namespace hmlfc
