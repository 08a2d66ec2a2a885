// Text of others on a terminal.
#include "terminal/shown.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hmlfc::terminal {
namespace {

TEST(Shown, TextStays) {
  for (const char* text :
       {"", "a\tb\n", "line\r\nline\n", "Straße 光場 🙂", "\\u001b", "\xC2\xA0\xEF\xBF\xBD"}) {
    EXPECT_EQ(shown(text), text);
  }
}

TEST(Shown, ControlsAndDirectionsAreEscaped) {
  EXPECT_EQ(shown("\x1b[31m\x1b]0;x\a\r\b"), "\\u001b[31m\\u001b]0;x\\u0007\\u000d\\u0008");
  EXPECT_EQ(shown(std::string_view("\0\x7f", 2)), "\\u0000\\u007f");
  EXPECT_EQ(shown("\xC2\x9B"
                  "2J"),
            "\\u009b2J");  // CSI in one character
  EXPECT_EQ(shown("a\xE2\x80\xAE"
                  "b\xE2\x81\xA6"),
            "a\\u202eb\\u2066");
}

TEST(Shown, BytesThatAreNoUtf8AreEscaped) {
  EXPECT_EQ(shown("\x9b\xff"), "\\u009b\\u00ff");
  EXPECT_EQ(shown("\xC0\x9B"), "\\u00c0\\u009b");  // longer than needed
  EXPECT_EQ(shown("\xE0\x80\x9B"), "\\u00e0\\u0080\\u009b");
  EXPECT_EQ(shown("\xED\xA0\x80"), "\\u00ed\\u00a0\\u0080");  // half of a surrogate pair
  EXPECT_EQ(shown("\xF4\x90\x80\x80"), "\\u00f4\\u0090\\u0080\\u0080");
  EXPECT_EQ(shown("\xE2\x80"), "\\u00e2\\u0080");  // cut off
}

TEST(Shown, JsonStaysTheSame) {
  const nlohmann::json json{{"name\x7f", "\x1b\xC2\x9B\xE2\x80\xAE\"\\"}};
  const std::string text = shown(json.dump(2));
  EXPECT_EQ(text.find('\x7f'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text), json);
}

}  // namespace
}  // namespace hmlfc::terminal
