#include <hmlfc/encoder.hpp>

#include "encoder/encode_run.hpp"

namespace hmlfc {

tl::expected<EncodedStream, EncodeError> encode(const LightField& light_field,
                                                const EncodeParams& params,
                                                const Progress& progress) {
  const auto header = checked_header(light_field.shape(), params);
  if (!header) return tl::unexpected(header.error());
  return run_encoder(params.threads, [&]() -> tl::expected<EncodedStream, EncodeError> {
    EncodeSession session(light_field, *header, params);
    ProgressCounter counter(progress, session.geometry().image_count());
    CodedImages images = session.encode(params.threshold_ref, params.threshold_pred, true,
                                        {[&] { counter.add(); }, {}});
    return EncodedStream{session.stream(images), images.error, params};
  });
}

}  // namespace hmlfc
