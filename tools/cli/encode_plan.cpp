#include "cli/encode_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/version.hpp>

#include "bits/crc32c.hpp"
#include "cli/output.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::cli {
namespace {

namespace fs = std::filesystem;

constexpr io::JsonLimits kPlanLimits{"a plan", size_t{1} << 24, 4};

// Names and sizes of all files of views.
Json inputs_json(const io::ViewList& list) {
  uint32_t crc = 0;
  for (const fs::path& file : list.files) {
    std::error_code failure;
    const auto size = fs::file_size(file, failure);
    const std::string line = fmt::format("{} {}\n", file.filename().string(), failure ? 0 : size);
    crc = crc32c({reinterpret_cast<const uint8_t*>(line.data()), line.size()}, crc);
  }
  return {{"count", list.files.size()}, {"crc", fmt::format("{:08x}", crc)}};
}

Json params_json(const EncodeParams& params) {
  return {{"profile", params.profile},
          {"method", params.method},
          {"cluster", {params.cluster_rows, params.cluster_cols}},
          {"tree_height", *params.tree_height},
          {"block_size", params.block_size},
          {"window", *params.window},
          {"references", {params.ref_rows, params.ref_cols}},
          {"chroma", *params.chroma},
          {"lossless", params.lossless},
          {"thresholds", {params.main.threshold_ref, params.main.threshold_pred}},
          {"rate_distortion", params.main.rate_distortion},
          {"quality", params.extended.quality},
          {"preset", params.extended.preset},
          {"disparity_grid", params.extended.disparity_grid}};
}

EncodeParams params_of(const Json& json) {
  EncodeParams params;
  json.at("profile").get_to(params.profile);
  json.at("method").get_to(params.method);
  json.at("cluster").at(0).get_to(params.cluster_rows);
  json.at("cluster").at(1).get_to(params.cluster_cols);
  params.tree_height = json.at("tree_height").get<int>();
  json.at("block_size").get_to(params.block_size);
  params.window = json.at("window").get<int>();
  json.at("references").at(0).get_to(params.ref_rows);
  json.at("references").at(1).get_to(params.ref_cols);
  params.chroma = json.at("chroma").get<ChromaFormat>();
  json.at("lossless").get_to(params.lossless);
  json.at("thresholds").at(0).get_to(params.main.threshold_ref);
  json.at("thresholds").at(1).get_to(params.main.threshold_pred);
  json.at("rate_distortion").get_to(params.main.rate_distortion);
  json.at("quality").get_to(params.extended.quality);
  json.at("preset").get_to(params.extended.preset);
  json.at("disparity_grid").get_to(params.extended.disparity_grid);
  return params;
}

Json range_json(const io::IndexRange& range) { return {range.first, range.last, range.step}; }

io::IndexRange range_of(const Json& json) {
  return {io::integer_at<uint32_t>(json, 0U), io::integer_at<uint32_t>(json, 1U),
          io::integer_at<uint32_t>(json, 2U)};
}

// The folder of views, what is taken of it, and the rig.
Json views_json(const EncodeOptions& options) {
  Json json{{"folder", fs::absolute(options.input).lexically_normal().string()}};
  const io::ViewNaming& naming = options.naming;
  json["grid"] = naming.grid ? Json{naming.grid->rows, naming.grid->cols} : Json();
  json["names"] = naming.pattern;
  json["order"] = naming.order ? Json(*naming.order) : Json();
  json["views"] =
      options.part ? Json{range_json(options.part->rows), range_json(options.part->cols)} : Json();
  json["rig"] = options.rig.file ? Json(fs::absolute(*options.rig.file).string()) : Json();
  json["no_rig"] = options.rig.none;
  return json;
}

EncodeOptions options_of(const Json& json) {
  EncodeOptions options;
  options.input = json.at("folder").get<std::string>();
  if (const Json& grid = json.at("grid"); !grid.is_null()) {
    options.naming.grid =
        io::GridShape{io::integer_at<uint32_t>(grid, 0U), io::integer_at<uint32_t>(grid, 1U)};
  }
  json.at("names").get_to(options.naming.pattern);
  if (const Json& order = json.at("order"); !order.is_null()) {
    options.naming.order = std::min(order.get<io::FrameOrder>(), io::kFrameOrders.back().second);
  }
  if (const Json& views = json.at("views"); !views.is_null()) {
    options.part = io::ViewPart{range_of(views.at(0)), range_of(views.at(1))};
  }
  if (const Json& rig = json.at("rig"); !rig.is_null()) options.rig.file = rig.get<std::string>();
  json.at("no_rig").get_to(options.rig.none);
  return options;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw Failure(ExitCode::kInput, file.string() + ": " + what);
}

// Fails unless the views of `plan` are those of `inputs`.
void check_inputs(const fs::path& file, const EncodeOptions& options, const Json& inputs) {
  if (inputs_json(listed_views(options)) == inputs) return;
  refuse(file,
         fmt::format("names or sizes of the views in {} are not those of the plan; make a new "
                     "plan",
                     options.input.string()));
}

}  // namespace

std::string plan_text(const EncodeOptions& options, const EncodeParams& params,
                      const PartGrid& parts, const io::ViewList& list) {
  const Json json{{"format", kPlanSign},           {"version", library_version()},
                  {"input", views_json(options)},  {"files", inputs_json(list)},
                  {"params", params_json(params)}, {"row_ends", parts.row_ends},
                  {"col_ends", parts.col_ends}};
  return io::json_text(json, 2) + "\n";
}

EncodePlan read_plan(const fs::path& file) {
  const auto mapped = value_or_throw(io::map_file(file), ExitCode::kInput);
  const auto bytes = mapped.bytes();
  const Json json = io::parse_json<Json>(bytes, kPlanLimits).value_or(Json());
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (format == json.end() || *format != kPlanSign) {
    refuse(file, "not a plan; `hmlfc encode VIEWS -o FILE --plan` writes one");
  }
  EncodePlan plan;
  try {
    const auto version = json.at("version").get<std::string>();
    if (version != library_version()) {
      refuse(file, fmt::format("a plan of version {}, and this is {}; make a new plan",
                               io::shown_json(version), library_version()));
    }
    plan.options = options_of(json.at("input"));
    plan.params = params_of(json.at("params"));
    json.at("row_ends").get_to(plan.parts.row_ends);
    json.at("col_ends").get_to(plan.parts.col_ends);
    check_inputs(file, plan.options, json.at("files"));
  } catch (const Json::exception& error) {
    refuse(file, std::string("a damaged plan: ") + error.what());
  }
  plan.options.coding.params = plan.params;
  plan.id = vectors::sha256(bytes);
  return plan;
}

}  // namespace hmlfc::cli
