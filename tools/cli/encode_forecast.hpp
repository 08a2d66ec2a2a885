// How long an encoding will take.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

namespace hmlfc::cli {

/// "Encoding 289 views of 1024 x 1024 pixels will take about 3 minutes", from the time that a small
/// part of each view takes here, with as many threads. Empty where encoding is soon done or the
/// views are too small for parts. For a `target`, several encodings are expected.
std::string encode_forecast(const LightField& field, const EncodeParams& params,
                            const std::optional<EncodeTarget>& target);

/// Notes the same of `parts` parts of a divided encoding, of which `done` took `seconds`, once:
/// after an eighth of them.
void note_forecast(size_t done, size_t parts, double seconds);

}  // namespace hmlfc::cli
