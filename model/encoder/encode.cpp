// One encoding, or a search for the one that meets a target.
#include <hmlfc/encoder.hpp>

#include <new>
#include <optional>

#include "bits/parallel.hpp"
#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/encode_progress.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/target_search.hpp"

namespace hmlfc {
namespace {

using Encoded = tl::expected<EncodedStream, EncodeError>;

Encoded refused(const char* message) { return tl::unexpected(EncodeError{message}); }

// With `trim`, the result meets a PSNR, and its key images have their quality from there.
EncodedStream encode_once(EncodeSession& session, EncodeParams params, bool last,
                          const Progress& progress, QualityTrim* trim = nullptr) {
  std::optional<CodedImages> images;
  while (!images) {
    if (trim != nullptr) params.extended.quality = trim->key_quality();
    ProgressCounter counter(progress, session.geometry().image_count());
    images = session.encode(params, last, {[&] { counter.add(); }, {}}, trim);
  }
  return {session.stream(*images), images->error, params};
}

// What a PSNR takes, and a number of bytes, as a multiple of one encoding; as measured: 1.1 to 6.
constexpr double kEncodingsOfPsnr = 1.5;
constexpr double kEncodingsOfBytes = 3;

// Checks and settles `params` for `goal`, null: their quality; calls body(session, settled coding).
template <class Body>
Encoded run_encoder(const LightField& light_field, const EncodeParams& params,
                    const EncodeGoal* goal, const Progress& progress, const ForecastSink& forecast,
                    const Body& body) {
  EncodeParams complete = with_defaults(params);
  if (goal != nullptr && goal->psnr() != nullptr) complete.chroma = params.chroma;  // by its PSNR
  if (const char* problem = problem_of(light_field.shape(), params)) return refused(problem);
  try {
    Encoded encoded;
    run_on_threads(params.threads, [&] {
      const FieldViews views(light_field);
      const SettledCoding settled = settle_coding(views, complete, goal, ~uint64_t{0}, progress);
      const auto header = header_for(light_field.shape(), settled.params);
      if (!header) {
        encoded = refused(kOutsideInterval);
        return;
      }
      if (forecast && settled.forecast) {
        const double encodings = goal == nullptr           ? 1
                                 : goal->psnr() != nullptr ? kEncodingsOfPsnr
                                                           : kEncodingsOfBytes;
        forecast({encodings * settled.forecast->seconds, settled.forecast->bytes});
      }
      EncodeSession session(views, *header, settled.probe);
      encoded = body(session, settled);
    });
    return encoded;
  } catch (const std::bad_alloc&) {
    return memory_is_out();
  }
}

}  // namespace

Encoded encode(const LightField& light_field, const EncodeParams& params, const Progress& progress,
               const ForecastSink& forecast) {
  return run_encoder(light_field, params, nullptr, progress, forecast,
                     [&](EncodeSession& session, const SettledCoding& settled) {
                       return encode_once(session, settled.params, true, progress);
                     });
}

bool seems_transposed(const LightField& light_field, int threads) {
  EncodeParams params = with_defaults({.ref_rows = 1, .ref_cols = 1});
  params.chroma = ChromaFormat::k444;
  const auto header = header_for(light_field.shape(), params);
  bool seems = false;
  run_on_threads(threads,
                 [&] { seems = header && seems_transposed(FieldViews(light_field), *header); });
  return seems;
}

Encoded encode_to(const LightField& light_field, const EncodeParams& params,
                  const EncodeTarget& target, const Progress& progress,
                  const ForecastSink& forecast) {
  const EncodeGoal goal(target);
  if (goal.psnr() != nullptr && !(goal.psnr()->db >= 1 && goal.psnr()->db <= 100)) {
    return refused("the target PSNR must lie in [1, 100] dB");
  }
  if (target == EncodeTarget(TargetBytes{0})) return refused("a stream has at least one byte");
  EncodeParams lossy = params;
  lossy.lossless = false;
  const LightFieldShape& shape = light_field.shape();
  const auto search = [&](EncodeSession& session, const SettledCoding& settled) {
    EncodeParams from = settled.params;
    const LevelShape& views = session.geometry().level(0);
    const bool predicts = views.ref_rows > 1 || views.ref_cols > 1;
    if (goal.psnr() != nullptr && predicts && from.profile == Profile::kExtended) {
      QualityTrim trim(from.extended.quality, shape, goal.psnr()->db, goal.tolerance_db(),
                       settled.db_per_quality);
      EncodedStream trimmed = encode_once(session, from, false, progress, &trim);
      const double surplus = goal.surplus_db(trimmed, shape);
      if (goal.is_near(surplus) || (trim.at_jump() && goal.is_met(surplus))) return trimmed;
      from = trimmed.params;
    }
    return search_target(shape, from, goal, [&](const EncodeParams& tried) {
      return encode_once(session, tried, false, progress);
    });
  };
  Encoded found = run_encoder(light_field, lossy, &goal, progress, forecast, search);
  if (!found || goal.is_met(goal.surplus_db(*found, shape))) return found;
  if (!goal.is_least()) {  // what trials settled for more bytes may take too many
    lossy.extended.quality = found->params.extended.quality;
    if (!params.chroma) lossy.chroma = ChromaFormat::k420;
    Encoded again = run_encoder(light_field, lossy, nullptr, progress, {}, search);
    return again && again->bytes.size() < found->bytes.size() ? again : found;
  }
  if (params.chroma || found->params.chroma == ChromaFormat::k444) return found;
  lossy.chroma = ChromaFormat::k444;  // what halved chroma costs one view is not what it costs all
  return run_encoder(light_field, lossy, &goal, progress, {}, search);
}

}  // namespace hmlfc
