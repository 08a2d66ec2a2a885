// Streams that the encoder makes of a synthetic scene.
#pragma once

#include <cstdint>
#include <vector>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// The stream of {"scene": {"name", "rows", "cols", "width", "height", "depth", "baseline"},
/// "encode": {...}}: the options of EncodeParams by name. `seed`: of the scene. Throws TextError
/// for a name or value that is none, or where the encoder refuses.
std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed);

}  // namespace hmlfc::vectors
