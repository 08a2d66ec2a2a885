#include "io/stream_report.hpp"

#include <utility>

#include <hmlfc/stream_info.hpp>

#include "io/disparity_range.hpp"
#include "io/stream_rig.hpp"

namespace hmlfc::io {
namespace {

const char* chroma_name(ChromaFormat format) {
  return format == ChromaFormat::k444 ? "444" : "420";
}

double pixels(const StreamHeader& header) {
  return static_cast<double>(header.rows) * header.cols * header.width * header.height;
}

OrderedJson key_images(const StreamHeader& header, int level, const LevelInfo& shape) {
  OrderedJson images = OrderedJson::array();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      if (image_info(header, level, row, col).kind != ImageKind::kKey) continue;
      images.push_back({row, col});
    }
  }
  return images;
}

OrderedJson range_json(const std::optional<DisparityRange>& counted) {
  if (!counted) return nullptr;
  const DisparityRange& range = *counted;
  OrderedJson json{{"known", range.known}, {"blocks", range.blocks}};
  if (range.known == 0) return json;
  json["least"] = static_cast<double>(range.least) / kDisparityUnits;
  json["greatest"] = static_cast<double>(range.greatest) / kDisparityUnits;
  return json;
}

OrderedJson rig_json(const MaybeRig& found) {
  if (!found) return nullptr;
  if (!*found) return {{"error", found->error()}};
  return parse_json<OrderedJson>(bytes_of((*found)->text), kRigLimits).value();
}

}  // namespace

double StreamReport::bits_per_pixel() const {
  return 8 * static_cast<double>(bytes) / pixels(header);
}

double StreamReport::ratio() const { return 3 * header.depth / bits_per_pixel(); }

std::array<std::pair<const char*, uint64_t>, 6> named_sections(const SectionBytes& sections) {
  using Row = std::pair<const char*, uint64_t>;
  return {Row{"header", sections.header}, Row{"index", sections.index},
          Row{"motion", sections.motion}, Row{"residual", sections.residual},
          Row{"top", sections.top},       Row{"other", sections.other}};
}

OrderedJson report_json(const StreamReport& report) {
  const StreamHeader& header = report.header;
  OrderedJson json{{"bytes", report.bytes},        {"bpp", report.bits_per_pixel()},
                   {"ratio", report.ratio()},      {"rows", header.rows},
                   {"cols", header.cols},          {"width", header.width},
                   {"height", header.height},      {"profile", profile_name(header.profile)},
                   {"method", method_name(header)}};
  OrderedJson& sections = json["sections"];
  for (const auto& [name, bytes] : named_sections(report.statistics.sections))
    sections[name] = bytes;
  return json;
}

void add_structure(const StreamReport& report, OrderedJson& json) {
  const StreamHeader& header = report.header;
  json["depth"] = header.depth;
  json["chroma"] = chroma_name(header.chroma_format);
  json["block"] = header.block_size();
  json["window"] = header.window;
  json["cluster"] = {header.cluster_rows, header.cluster_cols};
  json["tree_height"] = header.tree_height;
  json["tools"] = tools_of(header);
  json["levels"] = levels_json(header);
  const auto& states = report.statistics.states;
  json["states"] = {{"zero", states[0]},
                    {"motion", states[1]},
                    {"motion_residual", states[2]},
                    {"residual", states[3]}};
}

OrderedJson levels_json(const StreamHeader& header) {
  OrderedJson levels = OrderedJson::array();
  for (int level = header.tree_height; level >= 0; --level) {
    const LevelInfo shape = level_info(header, level);
    OrderedJson json{{"level", level},
                     {"rows", shape.rows},
                     {"cols", shape.cols},
                     {"ref_rows", shape.ref_rows},
                     {"ref_cols", shape.ref_cols},
                     {"key_images", shape.key_images},
                     {"keys", OrderedJson::array()}};
    const bool few = uint64_t{shape.rows} * shape.cols <= kMostListedImages;
    if (few && shape.key_images > 0) json["keys"] = key_images(header, level, shape);
    levels.push_back(std::move(json));
  }
  return levels;
}

std::vector<std::string> tools_of(const StreamHeader& header) {
  std::vector<std::string> tools;
  for (unsigned bit = 0; bit < kFeatureCount; ++bit) {
    const auto feature = static_cast<Feature>(bit);
    if (header.has(feature)) tools.emplace_back(feature_name(feature));
  }
  return tools;
}

Result<OrderedJson> info_json(const Decoder& decoder, ByteSource& source) {
  const uint64_t bytes = source.bytes().size();
  const auto statistics = decoder.statistics();
  if (!statistics) return tl::unexpected(statistics.error());
  const auto disparities = disparity_range(decoder, bytes);
  if (!disparities) return tl::unexpected(disparities.error());
  const auto rig = rig_in_stream(source, decoder.header());
  if (!rig) return tl::unexpected(rig.error());
  const StreamReport report{bytes, decoder.header(), *statistics};
  OrderedJson json = report_json(report);
  add_structure(report, json);
  json["disparity"] = range_json(*disparities);
  json["rig"] = rig_json(*rig);
  return json;
}

}  // namespace hmlfc::io
