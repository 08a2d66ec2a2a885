// Changed recipes of the search for extreme streams.
#include "mutate_recipe.hpp"

#include <gtest/gtest.h>

namespace {

using hmlfc::stress::mutated;
using hmlfc::vectors::Json;
using hmlfc::vectors::Random;

TEST(MutatedRecipe, OfOneWithoutRules) {
  const Json bare{{"header", {{"rows", 1}, {"cols", 1}, {"width", 4}, {"height", 4}}}};
  Random random(4);
  int with_rules = 0;
  for (int i = 0; i < 1000; ++i) {
    const Json changed = mutated(bare, random);
    for (const char* name : {"fields", "reference"}) {
      if (changed.contains(name)) {
        EXPECT_TRUE(changed[name].is_object()) << changed;
        ++with_rules;
      }
    }
  }
  EXPECT_GT(with_rules, 500);
}

TEST(MutatedRecipe, StaysSmall) {
  Json recipe = hmlfc::vectors::Json{{"header", {{"rows", 2}, {"cols", 3}}}};
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    recipe = mutated(recipe, random);
    const Json& header = recipe["header"];
    EXPECT_LE(header["rows"].get<int>() * header["cols"].get<int>() * header["width"].get<int>() *
                  header["height"].get<int>(),
              9 * 70 * 70)
        << header;
  }
}

}  // namespace
