#include "cli/stream_report.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "cli/output.hpp"

namespace hmlfc::cli {
namespace {

using SectionRow = std::pair<const char*, uint64_t>;

std::array<SectionRow, 6> section_rows(const SectionBytes& sections) {
  return {SectionRow{"header", sections.header}, SectionRow{"index", sections.index},
          SectionRow{"motion", sections.motion}, SectionRow{"residual", sections.residual},
          SectionRow{"top", sections.top},       SectionRow{"other", sections.other}};
}

const char* chroma_name(ChromaFormat format) {
  return format == ChromaFormat::k444 ? "444" : "420";
}

double pixels(const StreamHeader& header) {
  return static_cast<double>(header.rows) * header.cols * header.width * header.height;
}

Json key_images(const StreamHeader& header, int level, const LevelInfo& shape) {
  Json images = Json::array();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      if (image_info(header, level, row, col).kind != ImageKind::kKey) continue;
      images.push_back({row, col});
    }
  }
  return images;
}

}  // namespace

double StreamReport::bits_per_pixel() const {
  return 8 * static_cast<double>(bytes) / pixels(header);
}

double StreamReport::ratio() const { return 3 * header.depth / bits_per_pixel(); }

StreamReport report_on(const StreamFile& file) {
  return {file.size(), file.header(), file.value(file.decoder().statistics())};
}

Json report_json(const StreamReport& report) {
  const StreamHeader& header = report.header;
  Json json{{"bytes", report.bytes},        {"bpp", report.bits_per_pixel()},
            {"ratio", report.ratio()},      {"rows", header.rows},
            {"cols", header.cols},          {"width", header.width},
            {"height", header.height},      {"profile", profile_name(header.profile)},
            {"method", method_name(header)}};
  Json& sections = json["sections"];
  for (const auto& [name, bytes] : section_rows(report.statistics.sections)) sections[name] = bytes;
  return json;
}

void add_structure(const StreamReport& report, Json& json) {
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

Json levels_json(const StreamHeader& header) {
  Json levels = Json::array();
  for (int level = header.tree_height; level >= 0; --level) {
    const LevelInfo shape = level_info(header, level);
    Json json{{"level", level},
              {"rows", shape.rows},
              {"cols", shape.cols},
              {"ref_rows", shape.ref_rows},
              {"ref_cols", shape.ref_cols},
              {"key_images", shape.key_images},
              {"keys", Json::array()}};
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

std::string describe_coding(const StreamHeader& header) {
  return fmt::format("{}, profile {}, {}x{} blocks, window {}, clusters of {}x{}, {}",
                     method_name(header), profile_name(header.profile), header.block_size(),
                     header.block_size(), header.window, header.cluster_rows, header.cluster_cols,
                     header.chroma_format == ChromaFormat::k444 ? "4:4:4" : "4:2:0");
}

std::string size_text(const StreamReport& report) {
  std::string text = fmt::format("Size          {} bytes, {:.4f} bpp, 1 : {:.1f}\n",
                                 grouped(report.bytes), report.bits_per_pixel(), report.ratio());
  for (const auto& [name, bytes] : section_rows(report.statistics.sections)) {
    if (bytes == 0) continue;
    text += fmt::format("  {:<10} {:>14} bytes {:5.1f} %\n", name, grouped(bytes),
                        100 * static_cast<double>(bytes) / static_cast<double>(report.bytes));
  }
  return text;
}

}  // namespace hmlfc::cli
