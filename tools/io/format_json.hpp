// Enumerators of <hmlfc/format.hpp> in JSON, by their names (json_members.hpp).
#pragma once

#include <array>
#include <string_view>

#include <hmlfc/format.hpp>

#include "io/json_members.hpp"

namespace hmlfc {

inline void visit(const io::Members& m, Plane& plane) {
  m.as_name(plane,
            std::array{plane_name(Plane::kY), plane_name(Plane::kCo), plane_name(Plane::kCg)});
}

inline void visit(const io::Members& m, Profile& profile) {
  m.as_name(profile, std::array{profile_name(Profile::kMain), profile_name(Profile::kExtended)});
}

inline void visit(const io::Members& m, ChromaFormat& format) {
  m.as_name(format, std::array<std::string_view, 2>{"420", "444"});
}

}  // namespace hmlfc
