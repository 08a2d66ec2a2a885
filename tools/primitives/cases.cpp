#include "primitives/cases.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hmlfc::primitives {
namespace {

enum Kind : uint64_t { kEnds, kSpecial, kMixed, kAnywhere, kKinds };

std::string hexadecimal(const std::vector<uint8_t>& bytes) {
  return bytes.empty() ? "-" : fmt::format("{:02x}", fmt::join(bytes, ""));
}

}  // namespace

Cases::Cases(const Primitive& primitive, const Request& request)
    : primitive_(primitive),
      random_(request.seed),
      count_(request.count.value_or(primitive.drawn * (request.level == 1 ? 1 : kLevelFactor))),
      inputs_(primitive.columns) {}

bool Cases::next() {
  if (primitive_.exhaustive()) {
    if (!next_of_all()) return false;
  } else {
    if (number_ == count_) return false;
    draw();
  }
  ++number_;
  return true;
}

// Gives each column that has no number yet its least one.
void Cases::fill_with_least() {
  while (inputs_.numbers.size() < primitive_.columns.size()) {
    const Column& column = primitive_.columns[inputs_.numbers.size()];
    inputs_.numbers.push_back(column.interval(inputs_).lo);
  }
}

// Counts up the last column that is not at the end of its interval.
bool Cases::next_of_all() {
  if (number_ > 0) {
    bool at_end = true;
    while (at_end) {
      if (inputs_.numbers.empty()) return false;
      const int64_t number = inputs_.numbers.back();
      inputs_.numbers.pop_back();
      const Column& column = primitive_.columns[inputs_.numbers.size()];
      at_end = number == column.interval(inputs_).hi;
      if (!at_end) inputs_.numbers.push_back(number + 1);
    }
  }
  fill_with_least();
  return true;
}

void Cases::draw() {
  inputs_.numbers.clear();
  for (const Column& column : primitive_.columns) {
    inputs_.numbers.push_back(draw_number(column.interval(inputs_)));
  }
  if (primitive_.bytes.draw) inputs_.bytes = primitive_.bytes.draw(inputs_, random_);
}

int64_t Cases::draw_number(Interval interval) {
  const auto [lo, hi] = interval;
  uint64_t kind = number_ % kKinds;
  if (kind == kMixed) kind = random_.below(kKinds);
  switch (kind) {
    case kEnds:
      return random_.chance(500) ? lo : hi;
    case kSpecial: {
      const int64_t power = int64_t{1} << random_.below(17);
      const int64_t near[] = {lo + 1, hi - 1, -1, 0, 1, power, power - 1, -power, 1 - power};
      return std::clamp(near[random_.below(std::size(near))], lo, hi);
    }
    default:
      return lo + random_.below(static_cast<uint64_t>(hi - lo) + 1);
  }
}

uint64_t count_cases(const Primitive& primitive, const Request& request) {
  Cases cases(primitive, request);
  if (!primitive.exhaustive()) return cases.drawn();
  while (cases.next()) {
  }
  return cases.number();
}

std::string line_of(const Primitive& primitive, const Inputs& inputs) {
  std::string line = joined(inputs.numbers);
  if (!primitive.bytes.range.empty()) {
    line += (line.empty() ? "" : " ") + hexadecimal(inputs.bytes);
  }
  return line;
}

std::string named(const Primitive& primitive, const Inputs& inputs) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < inputs.numbers.size(); ++i) {
    texts.push_back(fmt::format("{} {}", primitive.columns[i].name, inputs.numbers[i]));
  }
  if (!primitive.bytes.range.empty()) texts.push_back("bytes " + hexadecimal(inputs.bytes));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace hmlfc::primitives
