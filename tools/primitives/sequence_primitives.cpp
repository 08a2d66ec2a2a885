// Level codes and bounded integer sequences.
#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "primitives/primitive.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::primitives {
namespace {

Levels levels_of(const Inputs& in) { return levels_of_code(in["code"]); }

uint64_t bits_of_sequence(const Inputs& in) { return bise_bits(levels_of(in), in["count"]); }

std::string describe_levels(const Inputs& in) {
  const Levels levels = levels_of(in);
  const int digits = levels.digit == Digit::kTrit ? 3 : levels.digit == Digit::kQuint ? 5 : 1;
  return joined(levels.count, levels.plain_bits, digits);
}

std::string widths_of_window(const Inputs& in) {
  const VectorWidths widths = vector_widths(in["window"]);
  return joined(widths.component_bits, widths.max_code, widths.code_bits);
}

std::string values_of(const std::vector<uint8_t>& bytes, uint64_t start, const Inputs& in) {
  const uint64_t count = in["count"];
  std::vector<uint32_t> values;
  for (uint64_t i = 0; i < count; ++i) {
    values.push_back(bise_value(BitString(bytes), start, levels_of(in), count, i));
  }
  return joined(values);
}

std::string unpack(const Inputs& in) {
  const uint32_t packed = in["packed"];
  BitWriter writer;
  writer.put(packed, narrow<unsigned>(bits_of_sequence(in)));
  return values_of(writer.bytes(), 0, in);
}

Bytes sequence_bytes() {
  return random_bytes("a bit string that ends with the byte in which the sequence ends",
                      [](const Inputs& in) {
                        return ceil_div(uint64_t{in["start"]} + bits_of_sequence(in), uint64_t{8});
                      });
}

std::vector<Primitive> level_primitives() {
  return {
      {"levels",
       "BISE-1 BISE-2",
       {within("code", 0, kMaxLevelCode)},
       {},
       "N n values_of_a_digit",
       kAll,
       describe_levels},
      {"least-code",
       "BISE-1 TIL-6 MOT-3",
       {within("levels", 1, 255)},
       {},
       "code",
       kAll,
       [](const Inputs& in) { return joined(level_code_for(in["levels"])); }},
      {"vector-fields",
       "TIL-6",
       {within("window", 0, kMaxWindow)},
       {},
       "v K c",
       kAll,
       widths_of_window},
  };
}

std::vector<Primitive> digit_primitives() {
  return {
      {"trits",
       "BISE-8",
       {within("T", 0, 255)},
       {},
       "t0 t1 t2 t3 t4",
       kAll,
       [](const Inputs& in) { return joined(trits_of_code(in["T"])); }},
      {"quints",
       "BISE-9",
       {within("Q", 0, 127)},
       {},
       "q0 q1 q2",
       kAll,
       [](const Inputs& in) { return joined(quints_of_code(in["Q"])); }},
  };
}

}  // namespace

std::vector<Primitive> sequence_primitives() {
  std::vector<Primitive> list = level_primitives();
  for (const Primitive& primitive : digit_primitives()) list.push_back(primitive);
  list.push_back({"sequence-bits",
                  "BISE-3",
                  {within("code", 0, kMaxLevelCode), within("count", 0, 64)},
                  {},
                  "bits",
                  kAll,
                  [](const Inputs& in) { return joined(bits_of_sequence(in)); }});
  list.push_back({"sequence-tail",
                  "BISE-4 BISE-5 BISE-6 BISE-7 BISE-10",
                  {within("code", 1, 5),
                   within("count", 1, 5),
                   {"packed", "every integer of as many bits as the sequence",
                    [](const Inputs& in) {
                      return Interval{0, (int64_t{1} << bits_of_sequence(in)) - 1};
                    }}},
                  {},
                  "values",
                  kAll,
                  unpack});
  list.push_back(
      {"sequence",
       "BISE-2 BISE-4 BISE-5 BISE-6 BISE-7",
       {within("code", 0, kMaxLevelCode), within("count", 1, 64), within("start", 0, 15)},
       sequence_bytes(),
       "values",
       kDrawn,
       [](const Inputs& in) { return values_of(in.bytes, in["start"], in); }});
  list.push_back({"sequence-value",
                  "BISE-11",
                  {within("code", 0, kMaxLevelCode),
                   within("count", 1, 256),
                   within("start", 0, 15),
                   {"i", "[0, count - 1]",
                    [](const Inputs& in) {
                      return Interval{0, int64_t{in["count"]} - 1};
                    }}},
                  sequence_bytes(),
                  "value",
                  kDrawn,
                  [](const Inputs& in) {
                    return joined(bise_value(BitString(in.bytes), in["start"], levels_of(in),
                                             in["count"], in["i"]));
                  }});
  return list;
}

}  // namespace hmlfc::primitives
