#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

TEST(NaturalOrder, OrdersAsPeopleNumber) {
  const std::vector<std::string> ordered = {
      "",
      "1",
      "2",
      "10",
      "a",
      "a1b2",
      "a1b10",
      "a2b1",
      "a10",
      "a10b",
      "a99999999999999999998",
      "a99999999999999999999",
      "a100000000000000000000",
      "b1",
      "b01x",
      "ba",
  };
  for (size_t i = 0; i < ordered.size(); ++i) {
    for (size_t j = 0; j < ordered.size(); ++j) {
      const auto order = natural_order(ordered[i], ordered[j]);
      EXPECT_EQ(order < 0, i < j) << ordered[i] << " and " << ordered[j];
      EXPECT_EQ(order == 0, i == j) << ordered[i] << " and " << ordered[j];
    }
  }
}

TEST(NaturalOrder, LeadingZerosDoNotCount) {
  EXPECT_TRUE(natural_order("a7", "a007") == 0);
  EXPECT_TRUE(natural_order("a0", "a000") == 0);
  EXPECT_TRUE(natural_order("a007b", "a7c") < 0);
}

}  // namespace
}  // namespace hmlfc::io
