// The limits of JSON from outside: what they refuse, and what stands within them.
#include "io/json_text.hpp"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "temp_folder.hpp"

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr JsonLimits kLimits{"a test", size_t{1} << 24, 4, 20};

template <class T = Json>
tl::expected<T, std::string> parsed(const std::string& text, const JsonLimits& limits = kLimits) {
  return parse_json<T>({reinterpret_cast<const uint8_t*>(text.data()), text.size()}, limits);
}

std::string refusal(const std::string& text) {
  const auto json = parsed(text);
  return json ? "ok" : json.error();
}

std::string object_of(int members) {
  std::string text;
  for (int i = 0; i < members; ++i) text += ",\"" + std::to_string(i) + "\":0";
  return "{" + text.substr(members == 0 ? 0 : 1) + "}";
}

TEST(JsonText, Values) {
  for (const char* text :
       {"null", "true", "-1", "18446744073709551615", "0.5", R"("a\"[\\")", "[]", "{}",
        R"([[],{},[1,[2]],{"b":{"c":[]},"a":null}])", R"({"a":1,"b":[{"c":2},3]})"}) {
    EXPECT_EQ(parsed<OrderedJson>(text), OrderedJson::parse(text)) << text;
    EXPECT_EQ(parsed(text), Json::parse(text)) << text;
  }
}

TEST(JsonText, WhatIsRefused) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no JSON text: byte 1"},
      {"[1,]", "no JSON text: byte 4"},
      {"[1] 2", "no JSON text: byte 5"},
      {std::string("[1]\0", 4), "no JSON text: byte 4"},
      {"\"\xFF\"", "no JSON text: byte 2"},
      {"[1,\nNaN]", "no JSON text: byte 5, line 2, where JSON has no NaN or Infinity"},
      {"[1] // x", "no JSON text: byte 5, where JSON has no comments"},
      {"[1e999]", "no JSON text: a number is too large"},
      {R"({"a":1,"b":2,"\u0061":3})", R"(the member "a" is there twice)"},
      {"[[[[]]]]", "ok"},
      {"[[[[[]]]]]", "objects and arrays are nested deeper than the 4 of a test: byte 5"},
      {R"([[],[],[],[],[],"[[[[["])", "ok"},
      {R"({"a":{"b":{"c":{"d":{}}}}})",
       "objects and arrays are nested deeper than the 4 of a test: byte 21"},
      {R"(["\"[[[[[\\"])", "ok"},
      {R"(["123456789012345678"])", "ok"},
      {R"(["1234567890123456789"])",
       "a string or number is longer than the 20 bytes of a test: byte 22"},
      {"[12345678901234567890]", "ok"},
      {"[123456789012345678901]",
       "a string or number is longer than the 20 bytes of a test: byte 22"},
      {std::string((1 << 24) + 1, ' '), "16777217 bytes are more than the 16777216 of a test"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(refusal(text), expected);
}

// A list of members would be searched a million times.
TEST(JsonText, Members) {
  EXPECT_EQ(parsed(object_of(1000000))->size(), 1000000u);
  EXPECT_EQ(parsed<OrderedJson>(object_of(64))->size(), 64u);
  EXPECT_EQ(parsed<OrderedJson>(object_of(65)).error(), "an object has more than 64 members");
}

// As many objects as fit: each costs the same.
TEST(JsonText, ManyObjects) {
  std::string text = "[{}";
  while (text.size() + 4 < (size_t{1} << 22)) text += ",{}";
  EXPECT_EQ(parsed(text + "]")->size(), text.size() / 3);
}

TEST(JsonText, OfAFile) {
  const test::TempFolder folder;
  const auto file = folder.path() / "a.json";
  std::ofstream(file) << R"({"a": [1, 2]})";
  EXPECT_EQ(read_json_file<Json>(file, kLimits).value(), Json({{"a", {1, 2}}}));
  std::ofstream(file) << "{";
  EXPECT_EQ(read_json_file<Json>(file, kLimits).error().message,
            file.string() + ": no JSON text: byte 2");
  const auto none = folder.path() / "none.json";
  EXPECT_EQ(read_json_file<Json>(none, kLimits).error().message.find(none.string()), 0u);
}

TEST(JsonText, Shown) {
  EXPECT_EQ(shown_json("a\n\x1b[31m\x7f\"\xc3\xa9\xff"), R"("a\n\u001b[31m\u007f\"\u00e9\ufffd")");
  EXPECT_EQ(shown_json({{"a", {1, nullptr}}}), R"({"a":[1,null]})");
  EXPECT_EQ(shown_json(std::string(78, 'a')), "\"" + std::string(78, 'a') + "\"");
  EXPECT_EQ(shown_json(std::string(1 << 20, 'a')), "\"" + std::string(76, 'a') + "...");
}

}  // namespace
}  // namespace hmlfc::io
