#include "io/name_numbers.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "io/files.hpp"

namespace hmlfc::io {
namespace {

constexpr size_t kMostDigits = 18;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

size_t digits_end(std::string_view name, size_t at) {
  while (at < name.size() && is_digit(name[at])) ++at;
  return at;
}

// Whether a sign of a number stands at `at`.
bool is_sign(std::string_view name, size_t at) {
  if (at + 1 >= name.size() || (name[at] != '-' && name[at] != '+') || !is_digit(name[at + 1])) {
    return false;
  }
  return at == 0 || !(is_digit(name[at - 1]) || is_letter(name[at - 1]) || name[at - 1] == '.');
}

// The integer at `at`, which may have a sign.
std::optional<NameNumber> integer_at(std::string_view name, size_t at) {
  const size_t digits = is_sign(name, at) ? at + 1 : at;
  NameNumber number{at, digits_end(name, digits), {}};
  if (number.end == digits) return std::nullopt;
  if (number.end - digits > kMostDigits) return number;
  int64_t value = 0;
  std::from_chars(name.data() + digits, name.data() + number.end, value);
  number.value = name[at] == '-' ? -value : value;
  return number;
}

}  // namespace

std::vector<NameNumber> numbers_of(std::string_view name, bool decimals) {
  std::vector<NameNumber> numbers;
  for (size_t at = 0; at < name.size();) {
    if (!is_digit(name[at]) && !(decimals && is_sign(name, at))) {
      ++at;
      continue;
    }
    NameNumber number = *integer_at(name, at);
    const bool has_point = number.end < name.size() && name[number.end] == '.';
    const size_t fraction_end = has_point ? digits_end(name, number.end + 1) : 0;
    if (decimals && fraction_end > number.end + 1) number = {at, fraction_end, {}};
    at = number.end;
    numbers.push_back(number);
  }
  return numbers;
}

std::string form_of(std::string_view name, const std::vector<NameNumber>& numbers) {
  std::string form;
  size_t at = 0;
  for (const NameNumber& number : numbers) {
    form += std::string(name.substr(at, number.begin - at)) + '#';
    at = number.end;
  }
  form += name.substr(at);
  while (!form.empty() && !is_letter(form.back()) && form.back() != '#') form.pop_back();
  return lower_case(std::move(form));
}

tl::expected<NamePattern, std::string> NamePattern::parse(std::string_view text) {
  constexpr std::array<std::string_view, kFields> kNames{"{row}", "{col}", "{index}"};
  NamePattern pattern;
  pattern.segments_.emplace_back();
  Piece piece;
  const auto end_segment = [&] {
    pattern.segments_.back().push_back(std::exchange(piece, {}));
    pattern.segments_.emplace_back();
  };
  while (!text.empty()) {
    size_t field = 0;
    while (field < kFields && !text.starts_with(kNames[field])) ++field;
    if (field < kFields) {
      if (std::exchange(pattern.has_field_[field], true)) {
        return tl::unexpected("it has " + std::string(kNames[field]) + " twice");
      }
      piece.field = static_cast<Field>(field);
      pattern.segments_.back().push_back(std::exchange(piece, {}));
      text.remove_prefix(kNames[field].size());
      continue;
    }
    if (const size_t close = text.find('}'); text.front() == '{' && close != text.npos) {
      return tl::unexpected(std::string(text.substr(0, close + 1)) +
                            " is no field; there are {row}, {col} and {index}");
    }
    text.front() == '*' ? end_segment() : piece.text.push_back(text.front());
    text.remove_prefix(1);
  }
  pattern.segments_.back().push_back(piece);
  if (pattern.has_index() && pattern.has_position()) {
    return tl::unexpected(std::string("it has {index}, and {row} or {col} too"));
  }
  return pattern;
}

std::optional<size_t> NamePattern::end_of(const Segment& segment, std::string_view name, size_t at,
                                          Fields& fields) {
  for (const Piece& piece : segment) {
    if (!name.substr(at).starts_with(piece.text)) return std::nullopt;
    at += piece.text.size();
    if (!piece.field) continue;
    const auto number = integer_at(name, at);
    if (!number || !number->value) return std::nullopt;
    fields.at[*piece.field] = *number;
    at = number->end;
  }
  return at;
}

std::optional<std::vector<NameNumber>> NamePattern::match(std::string_view name, bool whole) const {
  Fields fields;
  for (NameNumber& number : fields.at) number.value = 0;
  size_t at = 0;
  for (size_t i = 0; i < segments_.size(); ++i) {
    const size_t last_begin = whole && i == 0 ? 0 : name.size();
    const bool to_end = whole && i + 1 == segments_.size();
    std::optional<size_t> end;
    for (; !end && at <= last_begin; ++at) {
      end = end_of(segments_[i], name, at, fields);
      if (to_end && end && *end != name.size()) end.reset();
    }
    if (!end) return std::nullopt;
    at = *end;
  }
  if (has_index()) return std::vector{fields.at[kIndex]};
  if (has_position()) return std::vector{fields.at[kRow], fields.at[kCol]};
  return std::vector<NameNumber>{};
}

}  // namespace hmlfc::io
