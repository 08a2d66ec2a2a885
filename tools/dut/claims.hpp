// What a decoder claims to decode, and why a stream is beyond it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>

#include "io/format_json.hpp"

namespace hmlfc {

/// Profile, conformance level, and own limits (FIL-7): the largest values of header fields.
/// Defaults are those of a decoder of everything.
struct Claims {
  Profile profile = Profile::kExtended;  ///< extended includes main (LVL-2)
  int level = 3;                         ///< conformance level (LVL-1), [0, 3]
  int64_t rows = 4096;
  int64_t cols = 4096;
  int64_t width = 65536;
  int64_t height = 65536;
  int64_t depth = 12;
  int64_t tree_height = 15;
  std::vector<unsigned> block_log2 = {1, 2, 3};
  bool geometry = true;        ///< of frames: profile geometry, else plane
  int64_t frame_width = 4096;  ///< of the largest frame, pixels
  int64_t frame_height = 4096;
};

/// A limit: its name, what it may be, [least, greatest], and the field that it limits.
struct ClaimedLimit {
  const char* name;
  int64_t Claims::*value;
  int64_t least;
  int64_t greatest;
  int64_t (*field)(const StreamHeader& header);
};

inline constexpr ClaimedLimit kClaimedLimits[] = {
    {"rows", &Claims::rows, 1, 4096, [](const StreamHeader& h) { return int64_t{h.rows}; }},
    {"cols", &Claims::cols, 1, 4096, [](const StreamHeader& h) { return int64_t{h.cols}; }},
    {"width", &Claims::width, 1, 65536, [](const StreamHeader& h) { return int64_t{h.width}; }},
    {"height", &Claims::height, 1, 65536, [](const StreamHeader& h) { return int64_t{h.height}; }},
    {"depth", &Claims::depth, 8, 12, [](const StreamHeader& h) { return int64_t{h.depth}; }},
    {"tree_height", &Claims::tree_height, 0, 15,
     [](const StreamHeader& h) { return int64_t{h.tree_height}; }}};

/// Members profile, level and limits of a JSON object; those that are missing keep their values.
inline void visit(const io::Members& m, Claims& claims) {
  m.given("profile", claims.profile);
  m.within("level", claims.level, 0, 3);
  if (m.reading() && !m.has("limits")) return;
  const io::Members limits = m.at("limits");
  for (const ClaimedLimit& limit : kClaimedLimits) {
    limits.within(limit.name, claims.*limit.value, limit.least, limit.greatest);
  }
  limits.given("block_log2", claims.block_log2);
  limits.refuse_others("\"limits\"");
}

/// Member renderer of the same object: what a renderer claims.
inline void visit_renderer(const io::Members& m, Claims& claims) {
  if (m.reading() && !m.has("renderer")) return;
  const io::Members renderer = m.at("renderer");
  std::string profile = claims.geometry ? "geometry" : "plane";
  renderer.given("profile", profile);
  claims.geometry = profile == "geometry";
  if (!claims.geometry && profile != "plane") {
    throw io::TextError("a renderer's \"profile\" is \"plane\" or \"geometry\"");
  }
  renderer.within("frame_width", claims.frame_width, 1, 4096);
  renderer.within("frame_height", claims.frame_height, 1, 4096);
  renderer.refuse_others("\"renderer\"");
}

/// Why a stream is beyond `claims`: "width 40, above 39"; nothing if it is not. `header` is null if
/// the stream's header cannot be read.
inline std::optional<std::string> beyond(const Claims& claims, Profile profile, int level,
                                         const StreamHeader* header) {
  const auto above = [](const char* name, int64_t value, int64_t limit) {
    return std::string(name) + " " + std::to_string(value) + ", above " + std::to_string(limit);
  };
  if (profile > claims.profile) return "profile " + std::string(profile_name(profile));
  if (level > claims.level) return above("level", level, claims.level);
  if (header == nullptr) return std::nullopt;
  for (const ClaimedLimit& limit : kClaimedLimits) {
    const int64_t value = limit.field(*header);
    if (value > claims.*limit.value) return above(limit.name, value, claims.*limit.value);
  }
  if (std::ranges::count(claims.block_log2, header->block_log2) != 0) return std::nullopt;
  return "block_log2 " + std::to_string(header->block_log2);
}

}  // namespace hmlfc
