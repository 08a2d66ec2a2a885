#include "io/rig_text.hpp"

#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace hmlfc::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFar = 1 << 20;  // of positions and picture positions (RIG-2)

// A rule of RIG-2 that does not hold.
struct Broken {
  std::string what;
};

[[noreturn]] void refuse(std::string what) { throw Broken{std::move(what)}; }

// The number `json` at `place`, in [lo, hi].
double number(const Json& json, const std::string& place, double lo, double hi) {
  if (!json.is_number()) refuse(fmt::format("{} must be a number", place));
  const auto value = json.get<double>();
  if (!(value >= lo && value <= hi)) {
    refuse(fmt::format("{} is {}; it must lie in [{}, {}]", place, value, lo, hi));
  }
  return value;
}

// The text as JSON: UTF-8 without a byte order mark, no member twice.
Json parse_text(std::span<const uint8_t> text) {
  if (text.size() > kMaxRigBytes) {
    refuse(fmt::format("{} bytes are more than the {} of a rig", text.size(), kMaxRigBytes));
  }
  if (text.size() >= 3 && text[0] == 0xEF && text[1] == 0xBB && text[2] == 0xBF) {
    refuse("it begins with a byte order mark; save it without one");
  }
  std::set<std::string> members;
  const auto note_members = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1 &&
        !members.insert(parsed.get<std::string>()).second) {
      refuse(fmt::format("the member \"{}\" is there twice", parsed.get<std::string>()));
    }
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), note_members);
  } catch (const Json::parse_error& error) {
    refuse(fmt::format("no JSON text: byte {}", error.byte));
  } catch (const Json::out_of_range&) {
    refuse("no JSON text: a number is too large");
  }
}

// The entries of array `member`: as many as one of `counts`, each of N numbers of which number i
// has the range ranges[i].
template <size_t N>
std::vector<std::array<double, N>> entries(const Json& rig, const char* member, bool one_for_all,
                                           uint64_t views,
                                           const std::array<std::pair<double, double>, N>& ranges) {
  const Json& json = rig.at(member);
  if (!json.is_array()) refuse(fmt::format("{} must be an array", member));
  if (json.size() != views && !(one_for_all && json.size() == 1)) {
    refuse(fmt::format("{} has {} entries; {} are needed{}", member, json.size(), views,
                       one_for_all ? ", or one for all views" : ", one for each view"));
  }
  std::vector<std::array<double, N>> all;
  for (size_t i = 0; i < json.size(); ++i) {
    if (!json[i].is_array() || json[i].size() != N) {
      refuse(fmt::format("{}[{}] must be an array of {} numbers", member, i, N));
    }
    std::array<double, N>& entry = all.emplace_back();
    for (size_t k = 0; k < N; ++k) {
      entry[k] = number(json[i][k], fmt::format("{}[{}][{}]", member, i, k), ranges[k].first,
                        ranges[k].second);
    }
  }
  return all;
}

void check_members(const Json& json) {
  if (!json.is_object()) refuse("it must be a JSON object");
  constexpr std::array<std::string_view, 5> kMembers{"schema", "metres_per_unit", "positions",
                                                     "rotations", "intrinsics"};
  for (const auto& [name, value] : json.items()) {
    if (std::ranges::find(kMembers, name) == kMembers.end()) {
      refuse(fmt::format("the member \"{}\" is not one of a rig", name));
    }
  }
  for (const char* name : {"schema", "positions"}) {
    if (!json.contains(name)) refuse(fmt::format("the member \"{}\" is missing", name));
  }
  if (!json["schema"].is_number() || json["schema"].get<double>() != 1) {
    refuse(fmt::format("schema is {}; this version reads 1", json["schema"].dump()));
  }
}

void check_rotations(const Rig& rig) {
  constexpr double kSlack = 1.0 / 1024;
  for (size_t i = 0; i < rig.rotations.size(); ++i) {
    const auto& [w, x, y, z] = rig.rotations[i];
    const double square = w * w + x * x + y * y + z * z;
    if (!(square >= 1 - kSlack && square <= 1 + kSlack)) {
      refuse(fmt::format("rotations[{}] has the length {}; it must be 1", i, std::sqrt(square)));
    }
  }
}

Rig rig_from(const Json& json, uint64_t views) {
  check_members(json);
  constexpr std::pair kPlace{-kFar, kFar};
  constexpr std::pair kUnit{-2.0, 2.0};  // of a quaternion; check_rotations has its length
  constexpr std::pair kFocal{1.0 / 16, kFar};
  Rig rig;
  if (json.contains("metres_per_unit")) {
    rig.metres_per_unit =
        number(json["metres_per_unit"], "metres_per_unit", std::ldexp(1, -40), std::ldexp(1, 40));
  }
  rig.positions = entries<3>(json, "positions", false, views, {kPlace, kPlace, kPlace});
  if (json.contains("rotations")) {
    rig.rotations = entries<4>(json, "rotations", true, views, {kUnit, kUnit, kUnit, kUnit});
  }
  if (json.contains("intrinsics")) {
    rig.intrinsics = entries<4>(json, "intrinsics", true, views, {kFocal, kFocal, kPlace, kPlace});
  }
  check_rotations(rig);
  return rig;
}

// Numbers in the shortest decimals that are read as the same; 0 without a sign.
template <size_t N>
std::string entries_text(const std::vector<std::array<double, N>>& entries) {
  std::vector<std::string> texts;
  for (auto entry : entries) {
    for (double& value : entry) value += 0.0;  // -0 + 0 is 0
    texts.push_back(fmt::format("[{}]", fmt::join(entry, ",")));
  }
  return fmt::format("[{}]", fmt::join(texts, ","));
}

}  // namespace

tl::expected<Rig, std::string> parse_rig(std::span<const uint8_t> text, uint64_t views) {
  try {
    return rig_from(parse_text(text), views);
  } catch (Broken& broken) {
    return tl::unexpected(std::move(broken.what));
  }
}

std::string rig_text(const Rig& rig) {
  std::string text = R"({"schema":1)";
  if (rig.metres_per_unit) text += fmt::format(R"(,"metres_per_unit":{})", *rig.metres_per_unit);
  text += fmt::format(R"(,"positions":{})", entries_text(rig.positions));
  if (!rig.rotations.empty())
    text += fmt::format(R"(,"rotations":{})", entries_text(rig.rotations));
  if (!rig.intrinsics.empty()) {
    text += fmt::format(R"(,"intrinsics":{})", entries_text(rig.intrinsics));
  }
  text += '}';
  return text;
}

}  // namespace hmlfc::io
