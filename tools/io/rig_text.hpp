// The JSON text of a rig (specification, section 12).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include <hmlfc/rig.hpp>

#include "io/json_text.hpp"

namespace hmlfc::io {

/// RIG-2. Of 2^11 characters: any binary64 number can be written exactly.
inline constexpr JsonLimits kRigLimits{"a rig", kMaxRigBytes, 3, size_t{1} << 11};

/// The rig in `text`, which holds `views` views. Error: what is wrong and in which member, such as
/// "positions[3][1] is 2000000; it must lie in [-1048576, 1048576]".
tl::expected<Rig, std::string> parse_rig(std::span<const uint8_t> text, uint64_t views);

/// The shortest text of `rig`: parse_rig() gives the same numbers.
std::string rig_text(const Rig& rig);

}  // namespace hmlfc::io
