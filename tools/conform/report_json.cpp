#include <algorithm>

#include <fmt/format.h>

#include "conform/report.hpp"
#include "conform/report_folder.hpp"
#include "conform/summary.hpp"
#include "io/format_json.hpp"

namespace hmlfc::conform {

using io::Members;

namespace {

constexpr io::JsonLimits kReportLimits{"a report", size_t{1} << 26, 7};

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

// What follows from the results of a run.
void add_verdict(const Run& run, Json& json) {
  json["verdict"] = verdict_text(run);
  const Tally counts = tally(run);
  Json& counted = json["counts"];
  for (size_t i = 0; i < kStatusCount; ++i) counted[kStatusNames[i]] = counts.count[i];
  counted["waived"] = counts.waived;
  json["begin"] = to_json(summarise(run));
}

}  // namespace

static void visit(const Members& m, Status& status) { m.as_name(status, kStatusNames); }

static void visit(const Members& m, Difference& d) {
  m("view_row", d.view.row);
  m("view_col", d.view.col);
  m("block_x", d.block_x);
  m("block_y", d.block_y);
  m("x", d.x);
  m("y", d.y);
  m("expected", d.expected);
  m("actual", d.actual);
  m("wrong_blocks", d.wrong_blocks);
  m("blocks", d.blocks);
  m("wrong_views", d.wrong_views);
  m("channel", d.channel);
  m("planes", d.planes);
}

static void visit(const Members& m, VectorResult& result) {
  m("id", result.id);
  m("status", result.status);
  m.unless_empty("reason", result.reason);
  m.unless_empty("kind", result.kind);
  m.unless_empty("stage", result.stage);
  m.unless_empty("messages", result.messages);
  m.unless_empty("pictures", result.pictures);
  m.unless_empty("waiver", result.waiver);
  m.unless_empty("comment", result.comment);
  m.unless_empty("inspect", result.inspect);
  m.unless_empty("view", result.view);
  m("difference", result.difference);
  m("seconds", result.seconds);
  m("clauses", result.clauses);
  m("milestone", result.milestone);
  m("bytes", result.bytes);
  m.unless_empty("telling", result.telling);
  m.unless_empty("not_counted", result.not_counted);
}

static void visit(const Members& m, Run& run) {
  m("dut", run.dut);
  m("command", run.command);
  m("profile", run.profile);
  m("level", run.level);
  m.unless_empty("milestone", run.milestone);
  if (!m.reading()) add_verdict(run, m.json());
  m("results", run.results);
  const auto wrong = std::ranges::find_if(
      run.results, [&](const VectorResult& result) { return !has_own_pictures(result, run.dut); });
  if (wrong == run.results.end()) return;
  throw io::TextError("result " + wrong->id.text() + " of a decoder has wrong pictures");
}

static void visit(const Members& m, SystemInfo& system) {
  m("program", system.program);
  m("date", system.date);
  m("host", system.host);
  m("processor", system.processor);
  m("threads", system.threads);
  m("memory_mib", system.memory_mib);
}

static void visit(const Members& m, Report& report) {
  m("vectors_version", report.vectors_version);
  m("manifest_sha256", report.manifest_sha256);
  m("system", report.system);
  m("runs", report.runs);
}

Json to_json(const VectorResult& result) { return io::written(result); }

Json to_json(const Report& report) { return io::written(report); }

std::optional<VectorResult> result_from_json(Json json, const std::string& dut) {
  try {
    VectorResult result;
    visit(Members(json, true), result);
    if (has_own_pictures(result, dut)) return result;
  } catch (const io::TextError&) {
  }
  return std::nullopt;
}

io::IoResult<Report> read_report(const std::filesystem::path& file) {
  auto read = io::read_json_file<Json>(file, kReportLimits);
  if (!read) return tl::unexpected(read.error());
  try {
    Report report;
    visit(Members(*read, true), report);
    return report;
  } catch (const io::TextError& error) {
    return io::file_error(file, std::string("is not a report of hmlfc conform: ") + error.what());
  }
}

}  // namespace hmlfc::conform
