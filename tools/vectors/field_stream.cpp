#include "vectors/field_stream.hpp"

#include <new>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/draw_motion.hpp"
#include "vectors/draw_tile.hpp"
#include "vectors/header_recipe.hpp"
#include "vectors/ones_behind.hpp"

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
      for (uint32_t row = 0; row < geometry.level(level).rows; ++row) {
        for (uint32_t col = 0; col < geometry.level(level).cols; ++col) {
          add_image(level, {row, col});
        }
      }
    }
    index_.finish();
    return assemble_stream(rules_.header, top_section(codestreams_, crcs_), index_);
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
    append_ones(rules, record, random_);
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
    auto coded = rules_.key_error > 0 ? encode_jpeg2000_lossy(samples, precision, rules_.key_error)
                                      : encode_jpeg2000(samples, precision);
    if (!coded) throw std::bad_alloc();
    if (rules_.key_error > 0) {
      samples = decode_jpeg2000(*coded, shape.width, shape.height, precision).value();
      for (int16_t& sample : samples.samples) {
        sample = static_cast<int16_t>(clamp(sample, range.lo, range.hi));
      }
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
  IndexLayout layout;
  layout.least_offset_bits = json.value("least_offset_bits", 1u);
  layout.spare_records = json.value("spare_records", 0u);
  layout.spare_bytes = json.value("spare_bytes", 0u);
  layout.records_of_empty = json.value("records_of_empty", false);
  return layout;
}

}  // namespace

std::vector<uint8_t> field_stream(StreamRules rules, uint64_t seed) {
  return FieldStream(std::move(rules), seed).run();
}

std::vector<uint8_t> field_stream(const Json& json, uint64_t seed) {
  const Json fields = json.value("fields", Json::object());
  Json reference = fields;
  reference.merge_patch(json.value("reference", Json::object()));
  return field_stream(
      {header_from(json.at("header")), index_from(json.value("index", Json::object())),
       FieldRules(fields), FieldRules(reference), json.value("key_error", 0.0)},
      seed);
}

}  // namespace hmlfc::vectors
