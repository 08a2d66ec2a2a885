// The cases of a primitive, one after another, and the lines that state them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "primitives/primitive.hpp"

namespace hmlfc::primitives {

/// Cases of level 2 for each one of level 1, where not all are taken.
inline constexpr uint32_t kLevelFactor = 32;

/// Which cases: those of one request are the same on every machine.
struct Request {
  uint64_t seed = 1;
  int level = 1;                  ///< 1 or 2
  std::optional<uint32_t> count;  ///< in place of the level's; not for exhaustive primitives
};

/// All cases of an exhaustive primitive in ascending order; of others as many as asked for, drawn
/// at random: a quarter of them at the ends of the intervals, a quarter near ends, powers of two
/// and 0, a quarter anywhere, a quarter mixed. More cases begin with those of fewer.
class Cases {
 public:
  Cases(const Primitive& primitive, const Request& request);

  /// Goes to the first or next case; false behind the last one.
  bool next();

  /// The case reached, from 1 on.
  uint64_t number() const { return number_; }

  const Inputs& inputs() const { return inputs_; }

  /// How many cases there are, where they are drawn.
  uint64_t drawn() const { return count_; }

 private:
  bool next_of_all();
  void draw();
  void fill_with_least();
  int64_t draw_number(Interval interval);

  const Primitive& primitive_;
  vectors::Random random_;
  uint64_t count_;
  uint64_t number_ = 0;
  Inputs inputs_;
};

/// How many cases there are.
uint64_t count_cases(const Primitive& primitive, const Request& request);

/// "8 255 -3 0f00": the inputs as a line begins with them, bytes in hexadecimal, "-" for no bytes.
std::string line_of(const Primitive& primitive, const Inputs& inputs);

/// "depth 8, y 255, co -3": the inputs by name.
std::string named(const Primitive& primitive, const Inputs& inputs);

}  // namespace hmlfc::primitives
