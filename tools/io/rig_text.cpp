#include "io/rig_text.hpp"

#include <array>
#include <bitset>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;

struct Range {
  double lo;
  double hi;
};

constexpr double kFar = 1 << 20;  // of positions and picture positions (RIG-2)
constexpr Range kPlace{-kFar, kFar};
constexpr Range kUnit{-2, 2};  // of a quaternion, whose length has a rule of its own
constexpr Range kFocal{0x1p-4, kFar};

struct Member {
  std::string_view name;
  size_t numbers;    // of an entry of its array; 0: it is a number itself
  bool one_for_all;  // whether the array may have 1 entry
  bool needed;
  Range ranges[4];  // of the numbers
};

constexpr std::array<Member, 5> kMembers{{
    {"schema", 0, false, true, {{1, 1}}},
    {"metres_per_unit", 0, false, false, {{0x1p-40, 0x1p40}}},
    {"positions", 3, false, true, {kPlace, kPlace, kPlace}},
    {"rotations", 4, true, false, {kUnit, kUnit, kUnit, kUnit}},
    {"intrinsics", 4, true, false, {kFocal, kFocal, kPlace, kPlace}},
}};
constexpr const Member* kSchema = &kMembers[0];
constexpr const Member* kPositions = &kMembers[2];
constexpr const Member* kRotations = &kMembers[3];

// Puts the parts of a text into a rig. The first that breaks a rule of RIG-2 ends the walk.
class RigReader final : public JsonHandler {
 public:
  explicit RigReader(uint64_t views) : views_(views) {}

  Rig rig;

  bool null() override { return other(nullptr); }
  bool boolean(bool value) override { return other(value); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return number(value);
  }
  bool string(string_t& value) override { return other(value); }

  bool start_object(size_t /*count*/) override {
    if (depth_ != 0) return other(Json::object());
    depth_ = 1;
    return true;
  }

  bool key(string_t& name) override {
    const auto* found = std::ranges::find(kMembers, name, &Member::name);
    if (found == kMembers.end()) {
      return refuse(fmt::format("the member {} is not one of a rig", shown_json(name)));
    }
    const auto number = static_cast<size_t>(found - kMembers.begin());
    if (seen_[number]) return refuse(fmt::format("the member \"{}\" is there twice", name));
    seen_.set(number);
    member_ = found;
    return true;
  }

  bool end_object() override {
    for (size_t i = 0; i < kMembers.size(); ++i) {
      if (!kMembers[i].needed || seen_[i]) continue;
      return refuse(fmt::format("the member \"{}\" is missing", kMembers[i].name));
    }
    return true;
  }

  bool start_array(size_t /*count*/) override {
    if (depth_ == 0 || depth_ == 3 || member_->numbers == 0) return other(Json::array());
    if (depth_ == 2 && entries_ == views_) return wrong_count("more than ", views_);
    ++depth_;
    (depth_ == 2 ? entries_ : filled_) = 0;
    return true;
  }

  bool end_array() override {
    --depth_;
    if (depth_ == 2) return filled_ == member_->numbers ? end_entry() : other(Json::array());
    if (entries_ == views_ || (entries_ == 1 && member_->one_for_all)) return true;
    return wrong_count("", entries_);
  }

 private:
  // "positions[3][1]": the value that comes next.
  std::string place() const {
    std::string text(member_->name);
    if (depth_ > 1) text += fmt::format("[{}]", entries_);
    if (depth_ > 2) text += fmt::format("[{}]", filled_);
    return text;
  }

  // A value that is not what stands at this place.
  bool other(const Json& value) {
    if (depth_ == 0) return refuse("it must be a JSON object");
    if (member_ == kSchema) return wrong_schema(shown_json(value));
    if (depth_ == 2) {
      return refuse(fmt::format("{} must be an array of {} numbers", place(), member_->numbers));
    }
    const bool is_array = depth_ == 1 && member_->numbers != 0;
    return refuse(fmt::format("{} must be {}", place(), is_array ? "an array" : "a number"));
  }

  bool wrong_schema(const std::string& value) {
    return refuse(fmt::format("schema is {}; this version reads 1", value));
  }

  bool wrong_count(const char* more, uint64_t count) {
    return refuse(
        fmt::format("{} has {}{} entries; {} are needed{}", member_->name, more, count, views_,
                    member_->one_for_all ? ", or one for all views" : ", one for each view"));
  }

  bool number(double value) {
    const bool fits = depth_ == 3 || (depth_ == 1 && member_->numbers == 0);
    if (!fits) return other(value);
    if (filled_ == member_->numbers && depth_ == 3) {
      depth_ = 2;
      return other(value);
    }
    const auto [lo, hi] = member_->ranges[depth_ == 3 ? filled_ : 0];
    if (!(value >= lo && value <= hi)) {
      if (member_ == kSchema) return wrong_schema(fmt::format("{}", value));
      return refuse(fmt::format("{} is {}; it must lie in [{}, {}]", place(), value, lo, hi));
    }
    if (depth_ == 3) {
      entry_[filled_++] = value;
    } else if (member_ != kSchema) {
      rig.metres_per_unit = value;
    }
    return true;
  }

  bool end_entry() {
    constexpr double kSlack = 0x1p-10;
    const auto& [a, b, c, d] = entry_;
    if (const double square = a * a + b * b + c * c + d * d;
        member_ == kRotations && !(square >= 1 - kSlack && square <= 1 + kSlack)) {
      return refuse(fmt::format("{} has the length {}; it must be 1", place(), std::sqrt(square)));
    }
    if (member_ == kPositions) {
      rig.positions.push_back({a, b, c});
    } else {
      (member_ == kRotations ? rig.rotations : rig.intrinsics).push_back(entry_);
    }
    ++entries_;
    return true;
  }

  const uint64_t views_;
  std::bitset<kMembers.size()> seen_;
  const Member* member_ = nullptr;  // of which the values come
  int depth_ = 0;                   // 1: in the rig, 2: in the array of a member, 3: in an entry
  uint64_t entries_ = 0;            // that are whole
  size_t filled_ = 0;               // numbers of the entry
  std::array<double, 4> entry_{};
};

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
  if (text.size() >= 3 && text[0] == 0xEF && text[1] == 0xBB && text[2] == 0xBF) {
    return tl::unexpected(std::string("it begins with a byte order mark; save it without one"));
  }
  RigReader reader(views);
  if (auto walked = walk_json(text, kRigLimits, reader); !walked) {
    return tl::unexpected(std::move(walked.error()));
  }
  return std::move(reader.rig);
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
