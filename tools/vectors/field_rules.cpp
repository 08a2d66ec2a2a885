#include "vectors/field_rules.hpp"

#include <array>
#include <bit>
#include <set>
#include <string_view>

namespace hmlfc::vectors {

namespace {

constexpr std::array<std::string_view, 8> kMasks{"none",    "all",   "half",  "few",
                                                 "checker", "quads", "first", "last"};

const std::set<std::string>& known_fields() {
  static const std::set<std::string> names{
      "key",           "key_chroma",     "density",      "motion_mask",       "motion_mode",
      "sign_mode",     "sign",           "min_x",        "codes_x",           "dx",
      "min_y",         "codes_y",        "dy",           "residual_mask",     "residual_mode",
      "level_base",    "level_bits",     "level_code",   "bias_bits",         "bias",
      "value",         "group_code",     "tail_code",    "step_base",         "step_bits",
      "step_code",     "motion_density", "motion_block", "palette_size",      "explicit_bits",
      "reference_set", "choice",         "explicit_x",   "explicit_y",        "index",
      "min_disparity", "disparity_code", "disparity",    "disparity_density", "behind"};
  return names;
}

// The rule of a mask with numbers instead of words.
Json mask_numbers(const Json& json) {
  if (json.is_object()) {
    Json numbers = Json::array();
    for (const Json& word : json.at("of")) numbers.push_back(mask_numbers(word));
    return {{"of", numbers}};
  }
  for (size_t i = 0; i < kMasks.size(); ++i) {
    if (json == kMasks[i]) return i;
  }
  if (json == "random") return json;
  throw TextError(json.dump() + " is not a mask");
}

}  // namespace

FieldRule::Term FieldRule::term_from(const Json& json) {
  if (json.is_number_integer()) return {Kind::kConstant, json.get<int64_t>(), 0};
  if (json.is_array() && json.size() == 2) return {Kind::kInterval, json[0], json[1]};
  if (json == "random") return {Kind::kRandom};
  if (json == "min") return {Kind::kMin};
  if (json == "max") return {Kind::kMax};
  if (json == "ramp") return {Kind::kRamp};
  throw TextError(json.dump() +
                  " is not a rule: a number, [lo, hi], \"random\", \"min\", \"max\", " +
                  "\"ramp\" or {\"of\": [...]}");
}

FieldRule FieldRule::from(const Json& json) {
  FieldRule rule;
  if (!json.is_object()) {
    rule.terms_ = {term_from(json)};
    return rule;
  }
  rule.terms_.clear();
  for (const Json& term : json.at("of")) {
    if (term.is_object()) {
      const Json& run = term.at("run");
      rule.terms_.insert(rule.terms_.end(), run.at(0).get<uint16_t>(), term_from(run.at(1)));
    } else {
      rule.terms_.push_back(term_from(term));
    }
  }
  if (rule.terms_.empty()) throw TextError("\"of\" lists no rule");
  return rule;
}

int64_t FieldRule::pick(int64_t lo, int64_t hi, Random& random) {
  const uint64_t turn = picks_++;
  const Term& term = terms_[turn % terms_.size()];
  const auto within = [&](int64_t first, int64_t last) {
    return first + random.below(static_cast<uint64_t>(last - first) + 1);
  };
  switch (term.kind) {
    case Kind::kConstant:
      return term.first;
    case Kind::kInterval:
      return within(term.first, term.last);
    case Kind::kMin:
      return lo;
    case Kind::kMax:
      return hi;
    case Kind::kRamp:
      return lo +
             static_cast<int64_t>((turn / terms_.size()) % (static_cast<uint64_t>(hi - lo) + 1));
    case Kind::kRandom:
      break;
  }
  return within(lo, hi);
}

FieldRules::FieldRules(const Json& json) {
  for (const auto& [name, rule] : json.items()) {
    if (!known_fields().contains(name))
      throw TextError("\"" + name + "\" is not a field of a stream");
    rules_[name] = FieldRule::from(name.ends_with("_mask") ? mask_numbers(rule) : rule);
  }
}

int64_t FieldRules::pick(const std::string& field, int64_t lo, int64_t hi, Random& random) {
  return rules_[field].pick(lo, hi, random);
}

bool FieldRules::present(const std::string& density, Random& random) {
  if (!has(density)) return random.below(100) < 85;
  const int64_t percent = pick(density, 0, 100, random);
  return static_cast<int64_t>(random.below(100)) < percent;
}

uint64_t FieldRules::pick_mask(const std::string& mask, uint64_t inside, Random& random) {
  constexpr uint64_t kChecker = 0x6996966996696996;
  constexpr uint64_t kQuads = 0x0f0ff0f00f0ff0f0;
  switch (pick(mask, 0, kMasks.size() - 1, random)) {
    case 0:
      return 0;
    case 1:
      return inside;
    case 2:
      return random.next() & inside;
    case 3:
      return random.next() & random.next() & random.next() & inside;
    case 4:
      return kChecker & inside;
    case 5:
      return kQuads & inside;
    case 6:
      return inside & (~inside + 1);
    default:
      return std::bit_floor(inside);
  }
}

}  // namespace hmlfc::vectors
