// One encoding, or a search for the one that meets a target.
#include <hmlfc/encoder.hpp>

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>

#include "bits/parallel.hpp"
#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/target_search.hpp"

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

EncodedStream encode_once(EncodeSession& session, const EncodeParams& params, bool last,
                          const Progress& progress) {
  ProgressCounter counter(progress, session.geometry().image_count());
  const CodedImages images = session.encode(params, last, {[&] { counter.add(); }, {}});
  return {session.stream(images), images.error, params};
}

// Whether what trials may settle is open or in its interval.
bool has_known_extended_choices(const ExtendedParams& params) {
  const auto one_of = [](unsigned value, unsigned a, unsigned b) {
    return value == 0 || value == a || value == b;
  };
  return one_of(params.disparity_grid, 4, 8) && one_of(params.motion_tile, 64, 128) &&
         (params.key_weight == 0 || (params.key_weight >= 0.25 && params.key_weight <= 4));
}

// Checks and settles `params` for `goal`, null: for their quality, then calls body(session, settled
// params) on their threads.
template <class Body>
Encoded run_encoder(const LightField& light_field, const EncodeParams& params,
                    const EncodeGoal* goal, const Body& body) {
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
      const FieldViews views(light_field);
      const SettledCoding settled = settle_coding(views, complete, goal);
      const auto header = header_for(light_field.shape(), settled.params);
      if (!header) {
        encoded = refused(kOutside);
        return;
      }
      EncodeSession session(views, *header, settled.probe);
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
  return run_encoder(light_field, params, nullptr,
                     [&](EncodeSession& session, const EncodeParams& settled) {
                       return encode_once(session, settled, true, progress);
                     });
}

Encoded encode_to(const LightField& light_field, const EncodeParams& params,
                  const EncodeTarget& target, const Progress& progress) {
  const EncodeGoal goal(target);
  if (goal.psnr() != nullptr && !(goal.psnr()->db >= 1 && goal.psnr()->db <= 100)) {
    return refused("the target PSNR must lie in [1, 100] dB");
  }
  if (target == EncodeTarget(TargetBytes{0})) return refused("a stream has at least one byte");
  EncodeParams lossy = params;
  lossy.lossless = false;
  return run_encoder(
      light_field, lossy, &goal, [&](EncodeSession& session, const EncodeParams& settled) {
        return search_target(light_field.shape(), settled, goal, [&](const EncodeParams& tried) {
          return encode_once(session, tried, false, progress);
        });
      });
}

}  // namespace hmlfc
