// Choosing reference groups and chroma format of a light field by trial (profile extended).
#pragma once

#include <optional>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

namespace hmlfc {

/// `params` with its reference groups and chroma format settled where it leaves them to the encoder
/// (ref_rows = 0, automatic_chroma), at params.quality or for `target_db`. Groups are tried on the
/// middle of the views.
EncodeParams settle_coding(const LightField& light_field, const EncodeParams& params,
                           std::optional<double> target_db = std::nullopt);

}  // namespace hmlfc
