// Primitives: single operations of a decoder, each with the inputs that it may have and its result
// by the golden model (docs/primitives.md).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "arithmetic/widths.hpp"
#include "vectors/random.hpp"

namespace hmlfc::primitives {

/// An input that becomes the integer type in which it is used, which must hold it.
class Number {
 public:
  explicit Number(int64_t value) : value_(value) {}

  template <std::integral T>
  operator T() const {  // NOLINT: its purpose is to convert
    return narrow<T>(value_);
  }

 private:
  int64_t value_;
};

class Inputs;

/// The integers in [lo, hi]; lo <= hi.
struct Interval {
  int64_t lo;
  int64_t hi;
};

/// One integer among the inputs.
struct Column {
  std::string name;
  std::string range;                                ///< what it may be, as a reader sees it
  std::function<Interval(const Inputs&)> interval;  ///< the same by the inputs before it
};

/// The input of bytes, which follows the integers.
struct Bytes {
  std::string range;  ///< what they are; empty: the primitive takes no bytes
  std::function<std::vector<uint8_t>(const Inputs&, vectors::Random&)> draw;
};

/// The inputs of one case, or the first few of them.
class Inputs {
 public:
  explicit Inputs(const std::vector<Column>& columns) : columns_(columns) {}

  std::vector<int64_t> numbers;  ///< of the columns in their order
  std::vector<uint8_t> bytes;

  /// The number of column `name`, which must be among `numbers`.
  Number operator[](std::string_view name) const {
    size_t at = 0;
    while (columns_.at(at).name != name) ++at;
    return Number(numbers.at(at));
  }

 private:
  const std::vector<Column>& columns_;
};

/// One operation.
struct Primitive {
  std::string name;
  std::string clauses;  ///< separated by blanks
  std::vector<Column> columns;
  Bytes bytes;
  std::string results;                                 ///< their names
  uint32_t drawn;                                      ///< cases at level 1; 0: all that there are
  std::function<std::string(const Inputs&)> evaluate;  ///< the results as a line has them

  bool exhaustive() const { return drawn == 0; }
};

/// Cases at level 1 of a primitive that has too many to take all.
inline constexpr uint32_t kDrawn = 2000;
inline constexpr uint32_t kAll = 0;

/// A column with the same interval in every case. `meaning`: what a reader may not find under that
/// name in the clause, or empty.
Column within(std::string name, int64_t lo, int64_t hi, const std::string& meaning = {});

/// As many random bytes as `count` says; sometimes all 0 or all 1 bits.
Bytes random_bytes(std::string range, std::function<size_t(const Inputs&)> count);

/// The numbers of a list, separated by blanks, as a line has them.
template <std::ranges::range List>
std::string joined(const List& numbers) {
  std::string text;
  for (const auto number : numbers) text += (text.empty() ? "" : " ") + std::to_string(number);
  return text;
}

/// The same of numbers of any integer types.
template <std::integral... Types>
std::string joined(Types... numbers) {
  std::string text;
  ((text += (text.empty() ? "" : " ") + std::to_string(numbers)), ...);
  return text;
}

/// All primitives, in the order in which a decoder needs them.
const std::vector<Primitive>& all_primitives();

/// The one with this name, or none.
const Primitive* find_primitive(std::string_view name);

/// Those of each area, for all_primitives().
std::vector<Primitive> bit_primitives();
std::vector<Primitive> number_primitives();
std::vector<Primitive> sequence_primitives();
std::vector<Primitive> sample_primitives();
std::vector<Primitive> motion_primitives();
std::vector<Primitive> key_primitives();

}  // namespace hmlfc::primitives
