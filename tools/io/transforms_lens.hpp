// What a transforms.json says of lenses.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace hmlfc::io {

/// Empty where `object`, the file or one of its frames, has the lens of a pinhole camera or says
/// nothing of it; else which member says what, why it is not read, and the cure. `place` stands in
/// front of a member's name: "frames[3]." or "".
std::string lens_fault(const nlohmann::json& object, const std::string& place);

/// Which member of `object`, the file or a frame, tells a focal length in a way that is not read,
/// and the cure; empty without one.
std::string unread_focal_length(const nlohmann::json& object);

/// One frame, with what the file says for all frames behind it; lens_fault() accepts both.
struct TransformsFrame {
  const nlohmann::json& file;
  const nlohmann::json& frame;
  std::string place;  ///< "frames[3]"
};

/// Entry of RIG-2's intrinsics for pictures of width x height; nothing where `frame` has no focal
/// length. Error: a size of another aspect.
tl::expected<std::optional<std::array<double, 4>>, std::string> intrinsics_of(
    const TransformsFrame& frame, uint32_t width, uint32_t height);

}  // namespace hmlfc::io
