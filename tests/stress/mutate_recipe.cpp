#include "mutate_recipe.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace hmlfc::stress {
namespace {

using vectors::Json;
using vectors::Random;

const char* const kValueFields[] = {"key",
                                    "key_chroma",
                                    "sign_mode",
                                    "sign",
                                    "min_x",
                                    "codes_x",
                                    "dx",
                                    "min_y",
                                    "codes_y",
                                    "dy",
                                    "level_base",
                                    "level_bits",
                                    "level_code",
                                    "bias_bits",
                                    "bias",
                                    "value",
                                    "step_base",
                                    "step_bits",
                                    "step_code",
                                    "motion_block",
                                    "palette_size",
                                    "index",
                                    "explicit_bits",
                                    "explicit_x",
                                    "explicit_y",
                                    "reference_set",
                                    "min_disparity",
                                    "disparity_code",
                                    "disparity",
                                    "motion_mode",
                                    "residual_mode"};
const char* const kDensities[] = {"density", "motion_density", "disparity_density"};
const char* const kMasks[] = {"motion_mask", "residual_mask"};

template <class List>
const auto& one_of(const List& list, Random& random) {
  return list[random.below(std::size(list))];
}

Json random_rule(Random& random) {
  static const std::vector<Json> rules{"min",
                                       "max",
                                       "random",
                                       0,
                                       Json{{"of", {"min", "max"}}},
                                       Json{{"of", {"max", "min"}}},
                                       Json{{"of", {"max", "min", "max"}}},
                                       Json{{"of", {"min", "random", "max"}}}};
  return one_of(rules, random);
}

void change_rule(Json& rules, Random& random) {
  const unsigned kind = random.below(8);
  if (kind == 0) {
    rules[one_of(kDensities, random)] = random.below(3) == 0 ? 0 : 100;
  } else if (kind == 1) {
    rules[one_of(kMasks, random)] = random.below(4) == 0 ? "half" : "all";
  } else if (kind == 2) {
    rules["choice"] = random.below(12);
  } else if (kind == 3) {
    rules.erase(one_of(kValueFields, random));
  } else {
    rules[one_of(kValueFields, random)] = random_rule(random);
  }
}

void change_grid(Json& header, Random& random) {
  static const std::vector<int> sides{1, 2, 3, 5, 8, 64, 254, 255, 256, 509, 510, 511, 765};
  static const std::vector<int> groups{1, 2, 3, 8, 64, 254, 255};
  const bool rows = random.below(2) == 0;
  switch (random.below(3)) {
    case 0:
      header[rows ? "rows" : "cols"] = one_of(sides, random);
      return;
    case 1:
      header["levels"] =
          Json::array({{one_of(groups, random), one_of(groups, random), random.below(2)}});
      return;
    default:
      header["tree_height"] = random.below(4);
      header["cluster_rows"] = random.within(1, 3);
      header["cluster_cols"] = random.within(2, 3);
  }
}

void change_shape(Json& header, Random& random) {
  static const std::vector<int> sides{1, 2, 7, 16, 17, 64, 70};
  static const std::vector<int> windows{0, 1, 16, 63, 64, 127};
  const unsigned field = random.below(5);
  if (field == 0) header["depth"] = random.within(8, 12);
  if (field == 1) header["chroma_format"] = random.below(2) == 0 ? "420" : "444";
  if (field == 2) header["block_log2"] = random.within(1, 3);
  if (field == 3) header["window"] = one_of(windows, random);
  if (field == 4) header[random.below(2) == 0 ? "width" : "height"] = one_of(sides, random);
}

// Draws features, and valid values for the fields that depend on them.
void change_features(Json& header, Random& random) {
  Json features = Json::array();
  const auto maybe = [&](const char* name) {
    const bool on = random.below(2) == 0;
    if (on) features.push_back(name);
    return on;
  };
  for (const char* name :
       {"residual_step", "lossy_keys", "level_keys", "balanced_groups", "camera_rig"}) {
    maybe(name);
  }
  for (const char* name : {"vector_precision", "disparity_precision", "motion_tile_log2",
                           "disparity_grid_log2", "row_scale"}) {
    header.erase(name);
  }
  if (maybe("motion_tiles")) {
    header["motion_tile_log2"] = random.within(5, 7);
    unsigned precision = 0;
    if (maybe("subpel_vectors")) header["vector_precision"] = precision = random.within(1, 3);
    if (maybe("shared_disparity")) {
      header["disparity_precision"] = random.within(precision, 5);
      header["disparity_grid_log2"] = random.within(2, 5);
      header["row_scale"] = random.below(2) == 0 ? 127 : -127;
    }
    maybe("two_references");
    maybe("chroma_motion");
  }
  header["features"] = features;
}

// The rules of a recipe, added if it has none.
Json& rules_of(Json& recipe, const char* name) {
  Json& rules = recipe[name];
  if (rules.is_null()) rules = Json::object();
  return rules;
}

// Keeps a stream small: decoding time grows with the samples of all views.
void bound_size(Json& header) {
  const auto number = [&](const char* name) { return header.value(name, 1u); };
  const unsigned views = number("rows") * number("cols");
  const unsigned side = views > 256 ? 2 : views > 9 ? 8 : 70;
  header["width"] = std::min(header.value("width", 16u), side);
  header["height"] = std::min(header.value("height", 16u), side);
  if (views > 800) header["rows"] = 1;
}

}  // namespace

Json first_recipe(Random& random) {
  Json recipe{{"header", {{"rows", 2}, {"cols", 3}, {"width", 17}, {"height", 16}}},
              {"fields", Json::object()},
              {"reference", Json::object()},
              {"seed", random.below(1u << 30)}};
  recipe["header"]["levels"] = Json::array({{2, 3, 0}});
  change_features(recipe["header"], random);
  return recipe;
}

Json mutated(Json recipe, Random& random) {
  for (unsigned changes = 1 + random.below(4); changes > 0; --changes) {
    const unsigned kind = random.below(10);
    if (kind == 0) change_grid(recipe["header"], random);
    if (kind == 1) change_shape(recipe["header"], random);
    if (kind == 2) change_features(recipe["header"], random);
    if (kind == 3) recipe["seed"] = random.below(1u << 30);
    if (kind > 3) {
      change_rule(rules_of(recipe, random.below(2) == 0 ? "fields" : "reference"), random);
    }
  }
  bound_size(recipe["header"]);
  return recipe;
}

}  // namespace hmlfc::stress
