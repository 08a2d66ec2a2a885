#include <hmlfc/encoder.hpp>

#include "encoder/coding_choice.hpp"
#include "encoder/encode_run.hpp"
#include "encoder/extended_session.hpp"

namespace hmlfc {

namespace {

tl::expected<EncodedStream, EncodeError> encode_in_extended(const LightField& light_field,
                                                            const EncodeParams& params,
                                                            const Progress& progress) {
  const EncodeParams settled = settle_coding(light_field, params);
  const auto header = checked_header(light_field.shape(), settled);
  if (!header) return tl::unexpected(header.error());
  ProgressCounter counter(progress, Geometry(*header).image_count());
  ExtendedStream stream =
      encode_extended(light_field, *header, settled, {[&] { counter.add(); }, {}});
  return EncodedStream{assemble_extended(stream), stream.error, settled};
}

}  // namespace

tl::expected<EncodedStream, EncodeError> encode(const LightField& light_field,
                                                const EncodeParams& params,
                                                const Progress& progress) {
  if (auto ok = check_params(light_field.shape(), params); !ok) {
    return tl::unexpected(ok.error());
  }
  return run_encoder(params.threads, [&]() -> tl::expected<EncodedStream, EncodeError> {
    if (params.profile == Profile::kExtended) {
      return encode_in_extended(light_field, params, progress);
    }
    const auto header = checked_header(light_field.shape(), params);
    if (!header) return tl::unexpected(header.error());
    EncodeSession session(light_field, *header, params);
    ProgressCounter counter(progress, session.geometry().image_count());
    CodedImages images = session.encode(params.threshold_ref, params.threshold_pred, true,
                                        {[&] { counter.add(); }, {}});
    return EncodedStream{session.stream(images), images.error, params};
  });
}

}  // namespace hmlfc
