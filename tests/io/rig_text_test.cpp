// The text of a rig: every rule of RIG-2, the place that its error names, and the way back.
#include "io/rig_text.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hmlfc::io {
namespace {

tl::expected<Rig, std::string> parse(const std::string& text, uint64_t views) {
  return parse_rig({reinterpret_cast<const uint8_t*>(text.data()), text.size()}, views);
}

std::string complaint(const std::string& text, uint64_t views = 2) {
  const auto rig = parse(text, views);
  return rig ? "ok" : rig.error();
}

// A good rig of two views with `members` behind it.
std::string with(const std::string& members) {
  return R"({"schema": 1, "positions": [[0, 0, 0], [1, 2, 3]])" + members + "}";
}

TEST(RigText, EveryMember) {
  const auto rig = parse(with(R"(, "metres_per_unit": 0.5, "rotations": [[0, -1, 0, 0]],
                                 "intrinsics": [[8, 9, 1.5, -2], [0.0625, 1048576, 0, 0]])"),
                         2);
  ASSERT_TRUE(rig) << rig.error();
  EXPECT_EQ(*rig, (Rig{0.5,
                       {{0, 0, 0}, {1, 2, 3}},
                       {{0, -1, 0, 0}},
                       {{8, 9, 1.5, -2}, {0.0625, 1048576, 0, 0}}}));
  EXPECT_EQ(parse(with(""), 2), (Rig{{}, {{0, 0, 0}, {1, 2, 3}}, {}, {}}));
}

TEST(RigText, WhatIsWrongIsNamed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no JSON text: byte 1"},
      {with("") + "x", "no JSON text: byte 51"},
      {"{\"schema\": 1e999}", "no JSON text: a number is too large"},
      {"\xEF\xBB\xBF{}", "it begins with a byte order mark; save it without one"},
      {"[]", "it must be a JSON object"},
      {"{}", "the member \"schema\" is missing"},
      {R"({"schema": 1})", "the member \"positions\" is missing"},
      {R"({"schema": 2, "positions": []})", "schema is 2; this version reads 1"},
      {R"({"schema": "1", "positions": []})", "schema is \"1\"; this version reads 1"},
      {with(R"(, "model": 1)"), "the member \"model\" is not one of a rig"},
      {with(R"(, "schema": 1)"), "the member \"schema\" is there twice"},
      {R"({"schema": [1], "positions": []})", "schema is []; this version reads 1"},
      {R"({"schema": 1, "lens": 1, "positions": [)", "the member \"lens\" is not one of a rig"},
      {R"({"\u001b[31m": 1})", "the member \"\\u001b[31m\" is not one of a rig"},
      {with("") + std::string(3, '\0'), "no JSON text: byte 51"},
      {R"({"schema": 1, "positions": 7})", "positions must be an array"},
      {R"({"schema": 1, "positions": {}})", "positions must be an array"},
      {R"({"schema": 1, "positions": [7, [0, 0, 0]]})",
       "positions[0] must be an array of 3 numbers"},
      {R"({"schema": 1, "positions": [[0, 0, 0, 0], [0, 0, 0]]})",
       "positions[0] must be an array of 3 numbers"},
      {R"({"schema": 1, "positions": [[0, [0], 0], [0, 0, 0]]})",
       "objects and arrays are nested deeper than the 3 of a rig: byte 33"},
      {R"({"schema": 1, "positions": [[0, 0, 0]]})",
       "positions has 1 entries; 2 are needed, one for each view"},
      {R"({"schema": 1, "positions": [[0, 0, 0], [0, 0]]})",
       "positions[1] must be an array of 3 numbers"},
      {R"({"schema": 1, "positions": [[0, 0, 0], [0, null, 0]]})",
       "positions[1][1] must be a number"},
      {R"({"schema": 1, "positions": [[0, 0, -1048577], [0, 0, 0]]})",
       "positions[0][2] is -1048577; it must lie in [-1048576, 1048576]"},
      {with(R"(, "metres_per_unit": 0)"),
       "metres_per_unit is 0; it must lie in [9.094947017729282e-13, 1099511627776]"},
      {with(R"(, "rotations": [[1, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0]])"),
       "rotations has more than 2 entries; 2 are needed, or one for all views"},
      {with(R"(, "rotations": [[0.5, 0, 0, 0]])"), "rotations[0] has the length 0.5; it must be 1"},
      {with(R"(, "intrinsics": [[1, 0, 0, 0]])"),
       "intrinsics[0][1] is 0; it must lie in [0.0625, 1048576]"},
      {with(R"(, "intrinsics": [[1, 1, 0, 1e7]])"),
       "intrinsics[0][3] is 10000000; it must lie in [-1048576, 1048576]"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(complaint(text), expected) << text;
}

TEST(RigText, EndsOfTheRotations) {
  EXPECT_EQ(complaint(with(R"(, "rotations": [[1, 0.03125, 0, 0]])")), "ok");
  EXPECT_NE(complaint(with(R"(, "rotations": [[1, 0.0313, 0, 0]])")), "ok");
  EXPECT_EQ(complaint(with(R"(, "rotations": [[0, 0, 0.9996, 0]])")), "ok");
  EXPECT_NE(complaint(with(R"(, "rotations": [[0, 0, 0.999511, 0]])")), "ok");
}

TEST(RigText, TooLong) {
  std::string text = with("");
  text.resize(kMaxRigBytes, ' ');
  EXPECT_EQ(complaint(text), "ok");
  text += ' ';
  EXPECT_EQ(complaint(text), "16777217 bytes are more than the 16777216 of a rig");
}

// What a name or number is counts, not how it is written, up to 2048 characters of a number.
TEST(RigText, FormsOfNamesAndNumbers) {
  EXPECT_EQ(
      parse(R"({"sch\u0065ma": 0.1e1, "positions": [[0E9, -0, 1e-400], [1.0, 20e-1, 3]]})", 2),
      (Rig{{}, {{0, 0, 0}, {1, 2, 3}}, {}, {}}));
  EXPECT_EQ(complaint(with(R"(, "sch\u0065ma": 1)")), "the member \"schema\" is there twice");
  const auto zeros = [](size_t count) {
    return R"({"schema": 1, "positions": [[0, 0, 0.)" + std::string(count, '0') + "]]}";
  };
  EXPECT_EQ(complaint(zeros(2046), 1), "ok");
  EXPECT_EQ(complaint(zeros(2047), 1),
            "a string or number is longer than the 2048 bytes of a rig: byte 2084");
}

// Refused at once: a rig of any 2^24 bytes takes no time and memory by what else it holds.
TEST(RigText, LargeTexts) {
  const auto repeated = [](std::string begin, const std::string& part) {
    begin.reserve(kMaxRigBytes);
    while (begin.size() + part.size() <= kMaxRigBytes) begin += part;
    return begin;
  };
  const std::string deeper = "objects and arrays are nested deeper than the 3 of a rig: byte ";
  EXPECT_EQ(complaint(repeated("", "[")), deeper + "4");
  EXPECT_EQ(complaint(repeated("", "{\"a\":")), deeper + "16");
  EXPECT_EQ(complaint(repeated("{\"schema\": ", "[")), deeper + "14");
  std::string members = R"({"schema": 1)";
  for (int i = 0; members.size() + 20 < kMaxRigBytes; ++i) {
    members += ",\"" + std::to_string(i) + "\":1";
  }
  EXPECT_EQ(complaint(members + "}"), "the member \"0\" is not one of a rig");
  EXPECT_EQ(complaint(repeated(R"({"schema": 1, "positions": [)", "[0,0,0],")),
            "positions has more than 2 entries; 2 are needed, one for each view");
  EXPECT_EQ(complaint(repeated(R"({"schema": 1, "positions": [[)", "0,")),
            "positions[0] must be an array of 3 numbers");
  const std::string longer = "a string or number is longer than the 2048 bytes of a rig: byte ";
  EXPECT_EQ(complaint(repeated(R"({"schema": ")", "B")), longer + "2060");
  EXPECT_EQ(complaint(repeated("{\"", "A")), longer + "2050");
  EXPECT_EQ(complaint(repeated("{\"schema\": ", "1")), longer + "2060");
  EXPECT_EQ(complaint(R"({"schema": ")" + std::string(2000, 'B') + "\"}"),
            "schema is \"" + std::string(76, 'B') + "...; this version reads 1");
}

RC_GTEST_PROP(RigText, RoundTrip, ()) {
  const auto number = [](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(*rc::gen::arbitrary<uint32_t>()) / 4294967295.0;
  };
  const auto views = *rc::gen::inRange<size_t>(1, 6);
  const auto count = [&] { return *rc::gen::element<size_t>(0, 1, views); };
  Rig rig;
  if (*rc::gen::arbitrary<bool>()) rig.metres_per_unit = number(1e-12, 1e12);
  for (size_t i = 0; i < views; ++i) {
    rig.positions.push_back({number(-1e6, 1e6), number(-1, 1), number(0, 1e-9)});
  }
  for (size_t i = count(); i-- > 0;) {
    const double angle = number(-3, 3);
    rig.rotations.push_back({std::cos(angle), 0, std::sin(angle), 0});
  }
  for (size_t i = count(); i-- > 0;) {
    rig.intrinsics.push_back({number(1, 1e6), number(0.0625, 1), number(-9, 9), number(0, 1e6)});
  }
  const auto read = parse(rig_text(rig), views);
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == rig);
}

}  // namespace
}  // namespace hmlfc::io
