#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "conform/difference.hpp"
#include "conform/report.hpp"
#include "conform/report_folder.hpp"
#include "conform/summary.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

namespace fs = std::filesystem;

namespace {

constexpr size_t kPicturedFailures = 100;  // of each decoder, so that a page stays readable

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>HMLFC conformance</title><style>
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:75em;padding:0 1em;color:#222}
h1{font-size:1.6em}h2{font-size:1.25em;margin-top:2em;border-bottom:1px solid #ccc}h3{font-size:1em}
table{border-collapse:collapse}td,th{padding:.2em .6em;border:1px solid #ccc;text-align:left;vertical-align:top}
td.n{text-align:right}code,pre{font:13px/1.4 ui-monospace,monospace}pre{background:#f5f5f5;padding:.6em;overflow-x:auto}
.pass{background:#d9f2d9}.fail,.error,.timeout{background:#f8d0d0}.skipped{background:#fdf0c4}
.not_supported{background:#e8e8e8;color:#555}.waived{background:#e3d8f3}
.pictures{display:flex;flex-wrap:wrap;gap:1em}figure{margin:0}figcaption{font-size:.85em;color:#555}
img{image-rendering:pixelated;min-width:12em;max-width:20em;border:1px solid #999}
.grid{display:block;max-height:40em;overflow:auto}
</style></head><body>
)";

// data:image/png;base64,...
std::string png_data_uri(const std::vector<uint8_t>& png) {
  std::string text(4 * ((png.size() + 2) / 3) + 1, '\0');  // EVP_EncodeBlock ends with a zero
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), png.data(),
                                     static_cast<int>(png.size()));
  text.resize(static_cast<size_t>(length));
  return "data:image/png;base64," + text;
}

const char* css_class(const VectorResult& result) {
  return result.waived() ? "waived" : status_name(result.status).data();
}

std::string list(const std::vector<std::string>& words) {
  return escaped(fmt::format("{}", fmt::join(words, " ")));
}

std::string summary(const Report& report) {
  std::string text =
      "<h2>Decoders</h2><table><tr><th>decoder</th><th>verdict</th><th>profile</th><th>level</th>";
  for (size_t i = 0; i < kStatusCount; ++i) {
    text += fmt::format("<th>{}</th>", status_name(static_cast<Status>(i)));
  }
  text += "<th>waived</th></tr>\n";
  constexpr const char* kClasses[] = {"pass", "pass", "skipped", "fail"};  // by verdict
  for (const Run& run : report.runs) {
    const Tally counts = tally(run);
    text += fmt::format("<tr><td>{}</td><td class=\"{}\">{}</td><td>{}</td><td class=n>{}</td>",
                        escaped(run.dut), kClasses[static_cast<size_t>(verdict(run))],
                        verdict_text(run), escaped(run.profile), run.level);
    for (const uint64_t count : counts.count) text += fmt::format("<td class=n>{}</td>", count);
    text += fmt::format("<td class=n>{}</td></tr>\n", counts.waived);
  }
  return text + "</table>\n";
}

std::string system_table(const Report& report) {
  const SystemInfo& s = report.system;
  std::string text = fmt::format(
      "<h2>System</h2><table><tr><th>suite</th><td>{}, manifest SHA-256 <code>{}</code></td></tr>"
      "<tr><th>program</th><td>{}</td></tr><tr><th>date</th><td>{}</td></tr>"
      "<tr><th>system</th><td>{}</td></tr><tr><th>processor</th><td>{}, {} threads, {} "
      "MiB</td></tr>",
      escaped(report.vectors_version), escaped(report.manifest_sha256), escaped(s.program),
      escaped(s.date), escaped(s.host), escaped(s.processor), s.threads, s.memory_mib);
  for (const Run& run : report.runs) {
    text += fmt::format("<tr><th>{}</th><td><code>{}</code></td></tr>", escaped(run.dut),
                        list(run.command));
  }
  return text + "</table>\n";
}

std::string pictures(const VectorResult& result, const std::filesystem::path& folder) {
  std::string text = "<div class=pictures>";
  constexpr const char* kCaptions[] = {"expected", "actual", "difference times 16, grey if equal"};
  for (size_t i = 0; i < std::size(kFailurePictures); ++i) {
    const auto path = path_inside(folder, fs::path(result.pictures) / kFailurePictures[i]);
    const auto file = path.and_then([](const fs::path& picture) { return io::map_file(picture); });
    if (!file) continue;
    const auto bytes = file->bytes();
    text +=
        fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>",
                    kCaptions[i], png_data_uri({bytes.begin(), bytes.end()}));
  }
  return text + "</div>\n";
}

std::string failure(const VectorResult& result, const std::filesystem::path& folder,
                    bool with_pictures) {
  std::string text =
      fmt::format("<h3><span class=\"{}\">{}</span> {}</h3><p>{}</p>\n", css_class(result),
                  status_name(result.status), escaped(result.id.text()), escaped(result.reason));
  if (!result.waiver.empty()) text += "<p>Waived: " + escaped(result.waiver) + "</p>\n";
  if (!result.stage.empty()) text += "<p>First wrong stage: " + escaped(result.stage) + "</p>\n";
  text += fmt::format("<p>Clauses: {}. {}</p>\n", list(result.clauses), escaped(result.comment));
  if (!result.view.empty()) text += "<pre>" + escaped(result.view) + "</pre>\n";
  if (!result.pictures.empty() && with_pictures) text += pictures(result, folder);
  if (!result.messages.empty()) text += "<pre>" + escaped(result.messages) + "</pre>\n";
  return text;
}

// Milestones of a decoder: what it claims of each, and what passes.
std::string milestone_table(const Summary& summary) {
  std::string text = "<table><tr><th>milestone</th><th>a decoder</th><th>vectors</th></tr>\n";
  for (const MilestoneCount& count : summary.milestones) {
    const char* kind = count.bad != 0       ? "fail"
                       : count.claimed == 0 ? "not_supported"
                       : count.whole()      ? "pass"
                                            : "skipped";
    const std::string vectors =
        count.claimed == 0 ? "not claimed" : fmt::format("{} / {}", count.pass, count.claimed);
    text += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"n {}\">{}</td></tr>\n",
                        escaped(count.name), escaped(count.claim), kind, vectors);
  }
  return text + "</table>\n";
}

// What to look at first.
std::string where_to_begin(const Run& run, const Summary& summary) {
  std::string text = fmt::format("<h2>Where {} stands</h2>\n", escaped(run.dut));
  if (summary.first != nullptr) {
    text += fmt::format(
        "<p>The first milestone that is not whole is <b>{}</b>. Look first at <b>{}</b>: {}</p>"
        "<pre>{}\n{}</pre>\n",
        escaped(summary.first->name), escaped(summary.look_at->id.text()),
        escaped(summary.look_at->reason), escaped(summary.look_at->inspect),
        escaped(summary.look_at->view));
  }
  if (!summary.clauses.empty()) {
    text += "<p>Its clauses that fail in all vectors: " + list(summary.clauses) + "</p>\n";
  }
  return text + milestone_table(summary);
}

// Failures by their probable causes, then those that are waived.
std::string failures(const Run& run, const Summary& summary, const std::filesystem::path& folder) {
  std::string text;
  size_t count = 0;
  for (const Cause& cause : summary.causes) {
    text += fmt::format("<h2>{}: {} x {}</h2>\n", escaped(run.dut), cause.results.size(),
                        escaped(cause.text));
    for (const VectorResult* result : cause.results) {
      text += failure(*result, folder, count++ < kPicturedFailures);
    }
  }
  std::string waived;
  for (const VectorResult& result : run.results) {
    if (result.waived()) waived += failure(result, folder, count++ < kPicturedFailures);
  }
  if (!waived.empty()) text += fmt::format("<h2>{}: waived</h2>\n", escaped(run.dut)) + waived;
  return text;
}

// Clauses in rows, decoders in columns: how many of the vectors that exercise a clause pass.
std::string clause_grid(const Report& report) {
  struct Cell {
    size_t pass = 0;
    size_t bad = 0;
    size_t all = 0;
  };
  std::map<std::string, std::vector<Cell>> rows;
  for (size_t r = 0; r < report.runs.size(); ++r) {
    for (const VectorResult& result : report.runs[r].results) {
      for (const std::string& clause : result.clauses) {
        auto& row = rows[clause];
        row.resize(report.runs.size());
        if (result.status == Status::kNotSupported) continue;
        ++row[r].all;
        row[r].pass += result.status == Status::kPass;
        row[r].bad += result.bad();
      }
    }
  }
  std::string text =
      "<h2>Clauses</h2><p>Vectors passed, of those that exercise each clause and are claimed.</p>"
      "<div class=grid><table><tr><th>clause</th>";
  for (const Run& run : report.runs) text += "<th>" + escaped(run.dut) + "</th>";
  text += "</tr>\n";
  for (const auto& [clause, cells] : rows) {
    text += "<tr><td>" + escaped(clause) + "</td>";
    for (const Cell& cell : cells) {
      if (cell.all == 0) {
        text += "<td class=\"n not_supported\">not claimed</td>";
        continue;
      }
      const char* kind = cell.bad != 0 ? "fail" : cell.pass == cell.all ? "pass" : "skipped";
      text += fmt::format("<td class=\"n {}\">{} / {}</td>", kind, cell.pass, cell.all);
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string all_results(const Report& report) {
  std::string text = "<h2>Vectors</h2><table><tr><th>vector</th>";
  for (const Run& run : report.runs) text += "<th>" + escaped(run.dut) + "</th>";
  text += "<th>what it hunts</th></tr>\n";
  const auto& first = report.runs.front().results;
  for (size_t i = 0; i < first.size(); ++i) {
    text += "<tr><td>" + escaped(first[i].id.text()) + "</td>";
    for (const Run& run : report.runs) {
      const VectorResult& result = run.results[i];
      text += fmt::format("<td class=\"{}\" title=\"{}\">{}</td>", css_class(result),
                          escaped(result.reason), status_name(result.status));
    }
    text += "<td>" + escaped(first[i].comment) + "</td></tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  constexpr std::string_view kSpecial = "&<>\"";
  constexpr const char* kEntities[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string out;
  for (const char c : io::valid_utf8(text)) {
    const size_t special = kSpecial.find(c);
    if (special != std::string_view::npos) {
      out += kEntities[special];
    } else {
      out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return out;
}

std::string html_text(const Report& report, const std::filesystem::path& folder) {
  std::string text = kHead;
  text += fmt::format("<h1>HMLFC conformance, vectors {}</h1>\n", escaped(report.vectors_version));
  text += summary(report);
  for (const Run& run : report.runs) {
    const Summary found = summarise(run);
    text += where_to_begin(run, found);
    text += failures(run, found, folder);
  }
  text += clause_grid(report);
  if (!report.runs.empty()) text += all_results(report);
  text += system_table(report);
  return text + "</body></html>\n";
}

}  // namespace hmlfc::conform
