#include "conform/report.hpp"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "conform/report_folder.hpp"
#include "conform/summary.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {
namespace {

constexpr io::JsonLimits kReportLimits{"a report", size_t{1} << 26, 7};

// Calls field(key, member) for the numbers of a difference, to write or read them.
template <class D, class Field>
void for_each_number(D& d, const Field& field) {
  field("view_row", d.view.row);
  field("view_col", d.view.col);
  field("block_x", d.block_x);
  field("block_y", d.block_y);
  field("x", d.x);
  field("y", d.y);
  field("expected", d.expected);
  field("actual", d.actual);
  field("wrong_blocks", d.wrong_blocks);
  field("blocks", d.blocks);
  field("wrong_views", d.wrong_views);
}

Json to_json(const Difference& d) {
  Json json;
  for_each_number(d, [&](const char* key, const auto& value) { json[key] = value; });
  json["channel"] = std::string(1, d.channel);
  Json& planes = json["planes"] = Json::array();
  for (const Plane plane : d.planes) planes.push_back(plane_name(plane));
  return json;
}

Difference difference_from(const Json& json) {
  Difference d;
  for_each_number(
      d, [&]<class T>(const char* key, T& value) { value = io::integer_at<T>(json, key); });
  d.channel = json.at("channel").get<std::string>().at(0);
  for (const auto& name : json.at("planes").get<std::vector<std::string>>()) {
    const auto plane = std::ranges::find(kPlanes, name, plane_name);
    if (plane != kPlanes.end()) d.planes.push_back(*plane);
  }
  return d;
}

// Calls field(key, member) for the texts of a result that are left out where they are empty.
template <class R, class Field>
void for_each_text(R& result, const Field& field) {
  field("reason", result.reason);
  field("kind", result.kind);
  field("stage", result.stage);
  field("messages", result.messages);
  field("pictures", result.pictures);
  field("waiver", result.waiver);
  field("comment", result.comment);
  field("inspect", result.inspect);
  field("view", result.view);
}

void set_text(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json to_json(const SystemInfo& system) {
  return {{"program", system.program}, {"date", system.date},
          {"host", system.host},       {"processor", system.processor},
          {"threads", system.threads}, {"memory_mib", system.memory_mib}};
}

SystemInfo system_from(const Json& json) {
  return {json.at("program"),
          json.at("date"),
          json.at("host"),
          json.at("processor"),
          io::integer_at<unsigned>(json, "threads"),
          io::integer_at<uint64_t>(json, "memory_mib")};
}

Json to_json(const Summary& summary) {
  Json json;
  if (summary.first != nullptr) {
    json["milestone"] = summary.first->name;
    json["vector"] = summary.look_at->id.text();
    json["inspect"] = summary.look_at->inspect;
    json["view"] = summary.look_at->view;
    json["clauses"] = summary.clauses;
  }
  Json& milestones = json["milestones"] = Json::array();
  for (const MilestoneCount& count : summary.milestones) {
    milestones.push_back({{"name", count.name},
                          {"claimed", count.claimed},
                          {"pass", count.pass},
                          {"bad", count.bad},
                          {"skipped", count.skipped}});
  }
  Json& causes = json["causes"] = Json::array();
  for (const Cause& cause : summary.causes) {
    Json ids = Json::array();
    for (const VectorResult* result : cause.results) ids.push_back(result->id.text());
    causes.push_back({{"cause", cause.text}, {"vectors", ids}});
  }
  return json;
}

Json to_json(const Run& run) {
  Json json;
  json["dut"] = run.dut;
  json["command"] = run.command;
  json["profile"] = run.profile;
  json["level"] = run.level;
  set_text(json, "milestone", run.milestone);
  json["verdict"] = verdict_text(run);
  const Tally counts = tally(run);
  Json& counted = json["counts"];
  for (size_t i = 0; i < kStatusCount; ++i) {
    counted[std::string(status_name(static_cast<Status>(i)))] = counts.count[i];
  }
  counted["waived"] = counts.waived;
  json["begin"] = to_json(summarise(run));
  Json& results = json["results"] = Json::array();
  for (const VectorResult& result : run.results) results.push_back(conform::to_json(result));
  return json;
}

Run run_from(const Json& json) {
  Run run{json.at("dut"),
          json.at("command"),
          json.at("profile"),
          io::integer_at<int>(json, "level"),
          json.value("milestone", ""),
          {}};
  for (const Json& entry : json.at("results")) {
    auto result = result_from_json(entry, run.dut);
    if (!result) {
      throw vectors::TextError(fmt::format(
          "result {} of a decoder has a wrong id, status or pictures", run.results.size()));
    }
    run.results.push_back(std::move(*result));
  }
  return run;
}

}  // namespace

Json to_json(const VectorResult& result) {
  Json json;
  json["id"] = result.id.text();
  json["status"] = status_name(result.status);
  for_each_text(result,
                [&](const char* key, const std::string& text) { set_text(json, key, text); });
  if (result.difference) json["difference"] = to_json(*result.difference);
  json["seconds"] = result.seconds;
  json["clauses"] = result.clauses;
  json["milestone"] = result.milestone;
  json["bytes"] = result.bytes;
  if (result.telling) json["telling"] = true;
  if (result.not_counted) json["not_counted"] = true;
  return json;
}

std::optional<VectorResult> result_from_json(const Json& json, const std::string& dut) {
  try {
    VectorResult result;
    result.id = vectors::VectorId(json.at("id").get<std::string>());
    const auto status = status_from_name(json.at("status").get<std::string>());
    if (!status) return std::nullopt;
    result.status = *status;
    for_each_text(result, [&](const char* key, std::string& text) { text = json.value(key, ""); });
    if (!result.pictures.empty() && result.pictures != pictures_of(dut, result.id)) {
      return std::nullopt;
    }
    if (json.contains("difference")) result.difference = difference_from(json.at("difference"));
    result.seconds = json.at("seconds");
    result.clauses = json.at("clauses").get<std::vector<std::string>>();
    result.milestone = json.at("milestone");
    result.bytes = io::integer_at<uint64_t>(json, "bytes");
    result.telling = json.value("telling", false);
    result.not_counted = json.value("not_counted", false);
    return result;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

Json to_json(const Report& report) {
  Json json;
  json["vectors_version"] = report.vectors_version;
  json["manifest_sha256"] = report.manifest_sha256;
  json["system"] = to_json(report.system);
  Json& runs = json["runs"] = Json::array();
  for (const Run& run : report.runs) runs.push_back(to_json(run));
  return json;
}

io::IoResult<Report> read_report(const std::filesystem::path& file) {
  const auto read = io::read_json_file<Json>(file, kReportLimits);
  if (!read) return tl::unexpected(read.error());
  try {
    const Json& json = *read;
    Report report{
        json.at("vectors_version"), json.at("manifest_sha256"), system_from(json.at("system")), {}};
    for (const Json& run : json.at("runs")) report.runs.push_back(run_from(run));
    return report;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return io::file_error(file, std::string("is not a report of hmlfc conform: ") + error.what());
  }
}

}  // namespace hmlfc::conform
