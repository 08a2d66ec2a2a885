// Drives every quantity of the width table towards both ends of its interval.
#pragma once

#include <cstdint>
#include <vector>

#include "archive.hpp"
#include "session.hpp"

namespace hmlfc::stress {

/// The stream of a recipe: {"comment": text, "header": ..., "fields": ..., "reference": ...,
/// "seed": n} as in vectors/field_stream.hpp. Throws vectors::TextError.
std::vector<uint8_t> stream_of(const Json& recipe);

/// Hill climbing over recipes: of a target that is not reached, the closest recipe, or that of
/// another depth of the same quantity, is changed; what comes closer to any target is kept. Ends
/// after `seconds` or `most_streams`, or when all ends are reached. The same streams for the same
/// seed, `begin` and number of streams.
Archive search(Session& session, uint64_t seed, double seconds, uint64_t most_streams,
               const std::vector<Json>& begin);

}  // namespace hmlfc::stress
