// From the caller's parameters to those that an encoding runs with, and to its header.
#pragma once

#include <optional>

#include <hmlfc/encoder.hpp>
#include <hmlfc/error.hpp>

#include "encoder/encode_goal.hpp"
#include "encoder/light_field_probe.hpp"

namespace hmlfc {

/// Returns `params` with the profile's values instead of what is open, except for what is found by
/// trial: in profile extended reference groups and chroma format.
EncodeParams with_defaults(const EncodeParams& params);

/// The header that `params` ask for, without its sections; nothing is open. bad_header_field where
/// a parameter is outside its interval.
Result<StreamHeader> header_for(const LightFieldShape& shape, const EncodeParams& params);

inline constexpr const char* kOutsideInterval =
    "an encoding parameter is outside its interval (see hmlfc encode --help)";

/// Says what is wrong with `params` for a light field of `shape`; null: nothing.
const char* problem_of(const LightFieldShape& shape, const EncodeParams& params);

/// Parameters of which nothing is open, and what the light field was measured for.
struct SettledCoding {
  EncodeParams params;
  LightFieldProbe probe;
  double db_per_quality = kDbPerQuality;        ///< near the goal, as far as trials can say
  std::optional<EncodeForecast> forecast = {};  ///< for one encoding, where there were trials
};

/// Settles by trial what with_defaults() leaves open: the chroma format, and the reference groups
/// and the grid of disparities that cost least at params.extended.quality. For `goal`, if there is
/// one, the quality becomes the one with which trials meet it. Trials keep at most `cache_bytes` of
/// views; before each, `progress`, if there is one, is told that no view is done.
SettledCoding settle_coding(const ViewProvider& views, const EncodeParams& params,
                            const EncodeGoal* goal = nullptr, uint64_t cache_bytes = ~uint64_t{0},
                            const Progress& progress = {});

}  // namespace hmlfc
