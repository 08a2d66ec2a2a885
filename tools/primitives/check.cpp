#include "primitives/check.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace hmlfc::primitives {
namespace {

using Words = std::vector<std::string>;

// Lines of cases are much shorter.
constexpr size_t kMaxLine = size_t{1} << 16;

Words words_of(const std::string& line) {
  Words words;
  bool inside = false;
  for (const char letter : line) {
    const bool blank = letter == ' ' || letter == '\t' || letter == '\r';
    if (!blank && !inside) words.emplace_back();
    if (!blank) words.back() += letter;
    inside = !blank;
  }
  return words;
}

// The next line without its end, cut at kMaxLine; nothing at the end of the input.
std::optional<std::string> read_line(std::istream& lines) {
  std::string line;
  for (int letter = lines.get(); letter != std::istream::traits_type::eof(); letter = lines.get()) {
    if (letter == '\n') return line;
    if (line.size() < kMaxLine) line += static_cast<char>(letter);
  }
  if (line.empty()) return std::nullopt;
  return line;
}

// The beginning of a line, "?" for what a terminal may not be able to show.
std::string shortened(const std::string& line) {
  constexpr size_t kShown = 120;
  std::string shown = line.substr(0, kShown);
  std::ranges::replace_if(
      shown, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return line.size() <= kShown ? shown : shown + "...";
}

class Checker {
 public:
  Checker(const Primitive& primitive, const std::function<void(const std::string&)>& report)
      : primitive_(primitive), report_(report) {}

  // Whether the line is that of the case; `verdict_` has what is wrong with its results.
  bool compare(const Cases& at, const std::optional<std::string>& line) {
    const std::string inputs = line_of(primitive_, at.inputs());
    if (!line)
      return fail(
          fmt::format("the input ends before line {}, '{}'", at.number(), shortened(inputs)));
    const Words expected_inputs = words_of(inputs);
    const Words words = words_of(*line);
    const auto difference = std::ranges::mismatch(expected_inputs, words);
    if (difference.in1 != expected_inputs.end()) {
      return fail(fmt::format("line {} has to begin with '{}', but is '{}'{}", at.number(),
                              shortened(inputs), shortened(*line),
                              at.number() == 1 ? "; does gen have the same options?" : ""));
    }
    const Words results(difference.in2, words.end());
    const Words expected = words_of(primitive_.evaluate(at.inputs()));
    ++verdict_.compared;
    if (results != expected) report_wrong(at, results, expected);
    return true;
  }

  void too_many(uint64_t count, const std::string& line) {
    fail(
        fmt::format("there are {} cases, but the input goes on with '{}'", count, shortened(line)));
  }

  Verdict& verdict() { return verdict_; }

 private:
  bool fail(const std::string& message) {
    ++verdict_.errors;
    report_(message);
    return false;
  }

  void report_wrong(const Cases& at, const Words& results, const Words& expected) {
    const std::string place =
        fmt::format("line {}: {}", at.number(), shortened(named(primitive_, at.inputs())));
    if (results.size() != expected.size()) {
      fail(fmt::format("{}: {} results instead of {}: {} ({})", place, results.size(),
                       expected.size(), primitive_.results, primitive_.clauses));
      return;
    }
    const auto [actual, right] = std::ranges::mismatch(results, expected);
    const auto number = actual - results.begin() + 1;
    fail(fmt::format("{}: result {} of {} is {} instead of {}: {} ({})", place, number,
                     results.size(), shortened(*actual), *right, primitive_.results,
                     primitive_.clauses));
  }

  const Primitive& primitive_;
  const std::function<void(const std::string&)>& report_;
  Verdict verdict_;
};

}  // namespace

Verdict check(const Primitive& primitive, const Request& request, std::istream& lines,
              uint64_t max_errors, const std::function<void(const std::string&)>& report) {
  Checker checker(primitive, report);
  Verdict& verdict = checker.verdict();
  verdict.cases = count_cases(primitive, request);
  Cases cases(primitive, request);
  while (cases.next()) {
    if (!checker.compare(cases, read_line(lines))) return verdict;
    if (verdict.errors >= max_errors) return verdict;
  }
  if (const auto line = read_line(lines)) checker.too_many(verdict.cases, *line);
  return verdict;
}

}  // namespace hmlfc::primitives
