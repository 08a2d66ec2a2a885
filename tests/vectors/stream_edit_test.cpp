// Edits of recipes, which may come from anyone's suite.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "vectors/field_stream.hpp"
#include "vectors/stream_edit.hpp"

namespace hmlfc::vectors {
namespace {

TEST(StreamEdit, RefusesWhatLeavesTheStream) {
  const std::vector<uint8_t> intact = random_stream(1, {});
  for (const std::string edit : {
           R"({"resize": "TILE", "by": -100000000})",
           R"({"resize": "TILE", "by": -9223372036854775808})",
           R"({"resize": "TILE", "by": 4611686018427387904})",
           R"({"cut": -100000000})",
           R"({"cut": 4611686018427387904})",
           R"({"splice": 65361, "codestream": 0, "at": 100000000, "insert": [1]})",
           R"({"splice": 65361, "codestream": 0, "at": 0, "remove": 100000000, "insert": []})",
           R"({"bytes": "TILE", "at": 18446744073709551615, "value": [1, 2]})",
           R"({"header": "ref_rows", "level": 100, "value": 1})",
       }) {
    std::vector<uint8_t> bytes = intact;
    EXPECT_ANY_THROW(edit_stream(bytes, Json::parse(edit))) << edit;
  }
}

TEST(StreamEdit, ResizesASection) {
  std::vector<uint8_t> bytes = random_stream(1, {});
  const size_t size = bytes.size();
  edit_stream(bytes, {{"resize", "TILE"}, {"by", 5}});
  EXPECT_EQ(bytes.size(), size + 5);
  edit_stream(bytes, {{"resize", "TILE"}, {"by", -5}});
  EXPECT_EQ(bytes, random_stream(1, {}));
}

}  // namespace
}  // namespace hmlfc::vectors
