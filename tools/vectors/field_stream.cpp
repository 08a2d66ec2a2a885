#include "vectors/field_stream.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/draw.hpp"
#include "vectors/header_recipe.hpp"
#include "vectors/key_coding.hpp"

namespace hmlfc::vectors {

namespace {

class FieldStream {
 public:
  FieldStream(StreamRules rules, uint64_t seed)
      : rules_(std::move(rules)),
        random_(seed),
        stream_{{}, rules_.header, Geometry(rules_.header)},
        index_(rules_.index) {}

  std::vector<uint8_t> run() {
    const Geometry& geometry = stream_.geometry;
    for (int level = geometry.top(); level >= 0; --level) {
      for (const ImagePos at : geometry.level(level).all_images()) add_image(level, at);
    }
    index_.finish();
    return assemble_stream(rules_.header, top_section(codestreams_, crcs_), index_, rules_.rig);
  }

 private:
  void add_image(int level, ImagePos at) {
    const Geometry& geometry = stream_.geometry;
    const bool key = geometry.is_key(level, at);
    const bool reference = geometry.is_reference(level, at);
    FieldRules& rules = reference ? rules_.reference_fields : rules_.fields;
    for (const Plane plane : kPlanes) {
      if (key) add_key(plane);
      const PlaneShape& shape = geometry.plane(plane);
      for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
        for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
          if (key) {
            index_.add({});
          } else {
            add_tile(rules, {level, at.row, at.col, plane, tx * kTileBlocks, ty * kTileBlocks});
          }
        }
      }
    }
    for (size_t m = 0; m < geometry.motion_planes().size(); ++m) {
      const MotionPlaneShape& shape = geometry.motion_planes()[m];
      for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
        for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
          add_motion_tile(rules, {level, at, m, tx, ty}, reference);
        }
      }
    }
  }

  void add_tile(FieldRules& rules, const BlockSite& site) {
    const TileContext context = tile_context(stream_, site);
    const auto tile = draw_tile(rules, context, random_);
    auto record = tile ? write_tile_fields(*tile, context) : std::vector<uint8_t>{};
    append_trailing_ones(rules, record, random_);
    index_.add(std::move(record));
  }

  void add_motion_tile(FieldRules& rules, const MotionTilePlace& place, bool reference) {
    if (!reference) {
      index_.add(draw_motion_record(rules, motion_context(stream_, place), random_));
    } else if (rules_.header.has(Feature::kSharedDisparity)) {
      index_.add(draw_disparity_record(rules, disparity_context(stream_, place), random_));
    } else {
      index_.add({});
    }
  }

  void add_key(Plane plane) {
    const PlaneShape& shape = stream_.geometry.plane(plane);
    const int depth = rules_.header.depth;
    const SampleRange range = sample_range(plane, depth);
    SamplePlane samples(shape.width, shape.height);
    const bool chroma = plane != Plane::kY;
    FieldRules& rules = rules_.reference_fields;
    const char* field = chroma && rules.has("key_chroma") ? "key_chroma" : "key";
    for (int16_t& sample : samples.samples) {
      sample = static_cast<int16_t>(rules.pick(field, range.lo, range.hi, random_));
    }
    const SamplePrecision precision{depth + (chroma ? 1 : 0), chroma};
    CodestreamOptions coding = rules_.key_coding;
    coding.mean_squared_error = rules_.key_error;
    auto coded = encode_jpeg2000(samples, precision, coding);
    if (!coded) throw std::bad_alloc();
    if (rules_.key_error > 0) {
      samples = decode_jpeg2000(*coded, shape.width, shape.height).value();
      clamp_samples(samples, range);
    }
    crcs_.push_back(sample_crc(samples));
    codestreams_.push_back(std::move(*coded));
  }

  StreamRules rules_;
  Random random_;
  StreamView stream_;
  IndexWriter index_;
  std::vector<std::vector<uint8_t>> codestreams_;
  std::vector<uint32_t> crcs_;
};

IndexLayout index_from(const Json& json) {
  return {.least_offset_bits = json.value("least_offset_bits", 1u),
          .spare_records = json.value("spare_records", 0u),
          .spare_bytes = json.value("spare_bytes", 0u),
          .records_of_empty = json.value("records_of_empty", false)};
}

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

// From numbers of its own, so that a seed gives the same stream with and without it. Decoders of
// samples do not look at its bytes (RIG-1).
void draw_rig(StreamRules& rules, uint64_t seed) {
  Random random(~seed);
  if (rules.header.profile == Profile::kMain || random.below(2) == 0) return;
  rules.header.feature_flags |= feature_bit(Feature::kCameraRig);
  rules.rig.resize(random.below(40));
  for (uint8_t& byte : rules.rig) byte = static_cast<uint8_t>(random.below(256));
}

}  // namespace

std::vector<uint8_t> field_stream(StreamRules rules, uint64_t seed) {
  return FieldStream(std::move(rules), seed).run();
}

std::vector<uint8_t> field_stream(const Json& json, uint64_t seed) {
  const Json fields = json.value("fields", Json::object());
  Json reference = fields;
  reference.merge_patch(json.value("reference", Json::object()));
  const auto rig = json.value("rig", std::string());
  return field_stream({header_from(json.at("header")),
                       index_from(json.value("index", Json::object())),
                       FieldRules(fields),
                       FieldRules(reference),
                       json.value("key_error", 0.0),
                       key_coding_from(json.value("key_coding", Json::object())),
                       {rig.begin(), rig.end()}},
                      seed);
}

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
  limits.rig = json.value("rig", false);
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
  if (limits.rig) draw_rig(rules, seed);
  return field_stream(std::move(rules), random.next());
}

}  // namespace hmlfc::vectors
