// The numbers in names of pictures, and patterns that say which of them are meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace hmlfc::io {

/// One number of a name.
struct NameNumber {
  size_t begin = 0;  ///< its characters are [begin, end) of the name
  size_t end = 0;
  std::optional<int64_t> value;  ///< of an integer of up to 18 digits
};

/// The numbers of `name`. With `decimals` a fraction belongs to a number, and so does a sign at the
/// front of the name or after a separator: "a_-1.5" has the number -1.5, "a-1" the number 1.
/// Without, each run of digits is a number.
std::vector<NameNumber> numbers_of(std::string_view name, bool decimals);

/// `name` in small letters with # for each of its `numbers`, without separators at its end:
/// "out_#_#" of "Out_00_01_".
std::string form_of(std::string_view name, const std::vector<NameNumber>& numbers);

/// A pattern of names: {row}, {col} and {index} stand for an integer, * for any text, the rest for
/// itself.
class NamePattern {
 public:
  /// Fails, with the reason, where a field is there twice, {index} stands together with {row} or
  /// {col}, and where something else is in braces.
  static tl::expected<NamePattern, std::string> parse(std::string_view text);

  bool has_position() const { return has_field_[kRow] || has_field_[kCol]; }
  bool has_index() const { return has_field_[kIndex]; }

  /// Row and column, or the index, or nothing but a match: the numbers of `name` that stand at the
  /// fields; a row or column that the pattern lacks is 0. `whole`: all of the name is as the
  /// pattern, else the first part that is. Nothing for a name that does not match.
  std::optional<std::vector<NameNumber>> match(std::string_view name, bool whole) const;

 private:
  enum Field : uint8_t { kRow, kCol, kIndex, kFields };

  // Text that stands for itself, and then maybe a field.
  struct Piece {
    std::string text;
    std::optional<Field> field;
  };
  using Segment = std::vector<Piece>;
  struct Fields {
    NameNumber at[kFields];
  };

  static std::optional<size_t> end_of(const Segment& segment, std::string_view name, size_t at,
                                      Fields& fields);

  std::vector<Segment> segments_;  // between the stars
  bool has_field_[kFields] = {};
};

}  // namespace hmlfc::io
