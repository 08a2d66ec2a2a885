#include "vectors/random_stream.hpp"

#include <algorithm>
#include <array>

#include "vectors/field_stream.hpp"

namespace hmlfc::vectors {
namespace {

class HeaderDraw {
 public:
  HeaderDraw(const Limits& limits, Random& random) : limits_(limits), random_(random) {}

  StreamHeader draw() {
    draw_shape();
    draw_tree();
    if (!limits_.main || (limits_.extended && coin())) draw_features();
    for (int level = 0; level <= header_.tree_height; ++level) draw_level(level);
    return header_;
  }

 private:
  bool coin() { return random_.below(2) == 0; }
  uint32_t number(uint32_t lo, uint32_t hi) { return random_.within(lo, hi); }

  void draw_shape() {
    header_.rows = number(1, limits_.grid_side);
    header_.cols = number(1, limits_.grid_side);
    header_.width = number(1, limits_.view_side);
    header_.height = number(1, limits_.view_side);
    header_.depth = coin() ? 8 : static_cast<int>(number(8, static_cast<uint32_t>(limits_.depth)));
    header_.chroma_format = coin() ? ChromaFormat::k444 : ChromaFormat::k420;
    do {
      header_.block_log2 = number(1, 3);
    } while (((limits_.block_sizes >> (header_.block_log2 - 1)) & 1u) == 0);
    const auto widest = static_cast<uint32_t>(limits_.window);
    header_.window = static_cast<int>(number(0, coin() ? widest : std::min(widest, 12u)));
  }

  void draw_tree() {
    header_.tree_height = static_cast<int>(number(0, static_cast<uint32_t>(limits_.tree_height)));
    header_.cluster_rows = number(1, 3);
    header_.cluster_cols = number(header_.cluster_rows == 1 ? 2 : 1, 3);
  }

  void set(Feature feature, bool on) {
    if (on) header_.feature_flags |= feature_bit(feature);
  }

  void draw_features() {
    header_.profile = Profile::kExtended;
    for (const Feature feature : {Feature::kResidualStep, Feature::kLossyKeys, Feature::kLevelKeys,
                                  Feature::kBalancedGroups}) {
      set(feature, coin());
    }
    if (number(0, 4) == 0) return;
    set(Feature::kMotionTiles, true);
    for (const Feature feature : {Feature::kSubpelVectors, Feature::kSharedDisparity,
                                  Feature::kTwoReferences, Feature::kChromaMotion}) {
      set(feature, coin());
    }
    header_.motion_tile_log2 = number(5, 7);
    if (header_.has(Feature::kSubpelVectors)) header_.vector_precision = number(1, 3);
    if (!header_.has(Feature::kSharedDisparity)) return;
    header_.disparity_precision = number(header_.vector_precision, 5);
    header_.disparity_grid_log2 = number(2, 5);
    header_.row_scale = static_cast<int>(number(0, 254)) - 127;
  }

  void draw_level(int level) {
    const bool may_be_keyed = header_.has(Feature::kLevelKeys) && level < header_.tree_height;
    header_.levels.push_back({static_cast<uint8_t>(number(1, 4)),
                              static_cast<uint8_t>(number(1, 4)),
                              static_cast<uint8_t>(may_be_keyed && coin() ? 1 : 0)});
  }

  const Limits& limits_;
  Random& random_;
  StreamHeader header_;
};

}  // namespace

Limits limits_from(const Json& json) {
  Limits limits;
  limits.grid_side = json.value("grid_side", limits.grid_side);
  limits.view_side = json.value("view_side", limits.view_side);
  limits.depth = json.value("depth", limits.depth);
  limits.window = json.value("window", limits.window);
  limits.tree_height = json.value("tree_height", limits.tree_height);
  limits.main = json.value("main", limits.main);
  limits.extended = json.value("extended", limits.extended);
  limits.block_sizes = json.value("block_sizes", limits.block_sizes);
  return limits;
}

std::vector<uint8_t> random_stream(uint64_t seed, const Limits& limits) {
  Random random(seed);
  StreamRules rules;
  rules.header = HeaderDraw(limits, random).draw();
  rules.index.least_offset_bits = random.below(2) == 0 ? 1 : random.within(1, 32);
  rules.index.spare_records = random.below(3);
  rules.index.spare_bytes = random.below(3);
  rules.index.records_of_empty = random.below(2) == 0;
  if (rules.header.has(Feature::kLossyKeys)) rules.key_error = random.within(1, 2000);
  if (random.below(2) == 0) {
    const Json codes{{"group_code", "random"}};
    rules.fields = FieldRules(codes);
    rules.reference_fields = FieldRules(codes);
  }
  return field_stream(std::move(rules), random.next());
}

}  // namespace hmlfc::vectors
