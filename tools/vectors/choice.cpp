#include "vectors/choice.hpp"

namespace hmlfc::vectors {

Choice::Term Choice::term_from(const Json& json) {
  if (json.is_number_integer()) return {Kind::kConstant, json.get<int64_t>(), 0};
  if (json.is_array() && json.size() == 2) return {Kind::kInterval, json[0], json[1]};
  if (json == "random") return {Kind::kRandom};
  if (json == "min") return {Kind::kMin};
  if (json == "max") return {Kind::kMax};
  if (json == "ramp") return {Kind::kRamp};
  throw TextError(json.dump() +
                  " is no choice: a number, [lo, hi], \"random\", \"min\", \"max\", " +
                  "\"ramp\" or {\"of\": [...]}");
}

Choice Choice::from(const Json& json) {
  Choice choice;
  if (!json.is_object()) {
    choice.terms_ = {term_from(json)};
    return choice;
  }
  choice.terms_.clear();
  for (const Json& term : json.at("of")) choice.terms_.push_back(term_from(term));
  if (choice.terms_.empty()) throw TextError("\"of\" lists nothing to choose");
  return choice;
}

int64_t Choice::pick(int64_t lo, int64_t hi, Random& random) {
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

}  // namespace hmlfc::vectors
