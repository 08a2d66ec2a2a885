#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "conform/difference.hpp"
#include "conform/report.hpp"
#include "conform/report_folder.hpp"
#include "conform/summary.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

extern const char* const kReportStyle;  // tools/CMakeLists.txt

namespace fs = std::filesystem;

namespace {

constexpr size_t kPicturedFailures = 100;  // of each decoder, so that a page stays readable
constexpr size_t kOpenFailures = 3;        // of each cause; the others are folded

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>HMLFC conformance</title><style>
)";

// A table that scrolls in a box of its own.
std::string table(const std::string& rows) {
  return "<div class=scroll><table>" + rows + "</table></div>\n";
}

// What is shown once somebody asks for it; nothing if there is none.
std::string folded(size_t count, std::string_view what, const std::string& content) {
  if (count == 0) return {};
  return fmt::format("<details><summary>{} {}</summary>{}</details>\n", count, what, content);
}

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
  std::string text = "<tr><th>decoder</th><th>verdict</th><th>profile</th><th>level</th>";
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
  return table(text);
}

std::string system_table(const Report& report) {
  const SystemInfo& s = report.system;
  std::string text = fmt::format(
      "<tr><th>suite</th><td>{}, manifest SHA-256 <code>{}</code></td></tr>"
      "<tr><th>program</th><td>{}</td></tr><tr><th>date</th><td>{}</td></tr>"
      "<tr><th>system</th><td>{}</td></tr><tr><th>processor</th><td>{}, {} threads, {} "
      "MiB</td></tr>",
      escaped(report.vectors_version), escaped(report.manifest_sha256), escaped(s.program),
      escaped(s.date), escaped(s.host), escaped(s.processor), s.threads, s.memory_mib);
  for (const Run& run : report.runs) {
    text += fmt::format("<tr><th>{}</th><td><code>{}</code></td></tr>", escaped(run.dut),
                        list(run.command));
  }
  return "<h2>System</h2>" + table(text);
}

std::string pictures(const VectorResult& result, const std::filesystem::path& folder) {
  std::string text = "<div>";
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

// How many pass of those that were run, and how many were not.
std::string cell(const Count& count) {
  if (count.claimed == 0) return "<td class=\"n not_supported\">not claimed</td>";
  if (count.skipped == count.claimed) return "<td class=\"n skipped\">not run</td>";
  const char* kind = count.bad != 0 ? "fail" : count.whole() ? "pass" : "skipped";
  std::string text =
      fmt::format("<td class=\"n {}\">{} / {}", kind, count.pass, count.claimed - count.skipped);
  if (count.skipped != 0) text += fmt::format(", {} not run", count.skipped);
  return text + "</td>";
}

// What each milestone claims of a decoder, and what passes.
std::string milestone_table(const Run& run, const Summary& summary) {
  std::string text = "<tr><th>milestone</th><th>a decoder</th><th>vectors</th></tr>\n";
  for (const MilestoneCount& count : summary.milestones) {
    text += fmt::format("<tr><td>{}</td><td>{}</td>{}</tr>\n", escaped(count.name),
                        escaped(count.claim), cell(count));
  }
  return fmt::format("<h2>{}: milestones</h2>\n", escaped(run.dut)) + table(text);
}

// The vector to look at first.
std::string where_to_begin(const Run& run, const Summary& summary) {
  if (summary.first == nullptr) return {};
  std::string text = fmt::format(
      "<h2>{}: where to begin</h2>\n"
      "<p>The first milestone that is not whole is <b>{}</b>. Look first at <b>{}</b>: {}</p>"
      "<pre>{}\n{}</pre>\n",
      escaped(run.dut), escaped(summary.first->name), escaped(summary.look_at->id.text()),
      escaped(summary.look_at->reason), escaped(summary.look_at->inspect),
      escaped(summary.look_at->view));
  if (!summary.clauses.empty()) {
    text += "<p>Its clauses that fail in all vectors: " + list(summary.clauses) + "</p>\n";
  }
  return text;
}

// Failures by their probable causes, then those that are waived.
std::string failures(const Run& run, const Summary& summary, const std::filesystem::path& folder) {
  std::string text;
  size_t count = 0;
  for (const Cause& cause : summary.causes) {
    text += fmt::format("<h2>{}: {} x {}</h2>\n", escaped(run.dut), cause.results.size(),
                        escaped(cause.text));
    std::string more;
    for (size_t i = 0; i < cause.results.size(); ++i) {
      (i < kOpenFailures ? text : more) +=
          failure(*cause.results[i], folder, count++ < kPicturedFailures);
    }
    text +=
        folded(cause.results.size() - std::min(kOpenFailures, cause.results.size()), "more", more);
  }
  std::string waived;
  for (const VectorResult& result : run.results) {
    if (result.waived()) waived += failure(result, folder, count++ < kPicturedFailures);
  }
  if (!waived.empty()) text += fmt::format("<h2>{}: waived</h2>\n", escaped(run.dut)) + waived;
  return text;
}

// A table of rows by decoders: where something fails, where all is well, and what was not run.
class SortedRows {
 public:
  void add(const std::vector<Count>& counts, const std::string& row) {
    const auto bad = [](const Count& count) { return count.bad != 0; };
    const auto run = [](const Count& count) { return count.claimed != count.skipped; };
    const size_t place = std::ranges::any_of(counts, bad)   ? 0
                         : std::ranges::any_of(counts, run) ? 1
                                                            : 2;
    rows_[place].second += "<tr>" + row + "</tr>\n";
    ++rows_[place].first;
  }

  // first, last: heads of the columns around those of decoders.
  std::string text(const Report& report, const char* first, const char* last,
                   const char* what) const {
    std::string head = fmt::format("<tr><th>{}</th>", first);
    for (const Run& run : report.runs) head += "<th>" + escaped(run.dut) + "</th>";
    head += std::string(last) + "</tr>\n";
    const auto& [bad, well, others] = rows_;
    return (bad.first == 0 ? "" : table(head + bad.second)) +
           folded(well.first, fmt::format("{} without a failure", what),
                  table(head + well.second)) +
           folded(others.first, fmt::format("{} not run or not claimed", what),
                  table(head + others.second));
  }

 private:
  std::pair<size_t, std::string> rows_[3];
};

// Clauses in rows, decoders in columns: how many of the vectors that exercise a clause pass.
std::string clause_grid(const Report& report) {
  std::map<std::string, std::vector<Count>> clauses;
  for (size_t r = 0; r < report.runs.size(); ++r) {
    for (const VectorResult& result : report.runs[r].results) {
      for (const std::string& clause : result.clauses) {
        auto& counts = clauses[clause];
        counts.resize(report.runs.size());
        counts[r].add(result);
      }
    }
  }
  SortedRows rows;
  for (const auto& [clause, counts] : clauses) {
    std::string row = "<td>" + escaped(clause) + "</td>";
    for (const Count& count : counts) row += cell(count);
    rows.add(counts, row);
  }
  return "<h2>Clauses</h2><p>Vectors passed, of those that exercise each clause, are claimed and "
         "were run.</p>" +
         rows.text(report, "clause", "", "clauses");
}

std::string all_results(const Report& report) {
  SortedRows rows;
  const auto& first = report.runs.front().results;
  for (size_t i = 0; i < first.size(); ++i) {
    std::string row = "<td>" + escaped(first[i].id.text()) + "</td>";
    std::vector<Count> counts;
    for (const Run& run : report.runs) {
      const VectorResult& result = run.results[i];
      counts.emplace_back().add(result);
      row += fmt::format("<td class=\"{}\" title=\"{}\">{}</td>", css_class(result),
                         escaped(result.reason), status_name(result.status));
    }
    rows.add(counts, row + "<td>" + escaped(first[i].comment) + "</td>");
  }
  return "<h2>Vectors</h2>" + rows.text(report, "vector", "<th>what it hunts</th>", "vectors");
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
  text += fmt::format("{}</style></head><body>\n<h1>HMLFC conformance, vectors {}</h1>\n",
                      kReportStyle, escaped(report.vectors_version));
  text += summary(report);
  std::string milestones;
  for (const Run& run : report.runs) {
    const Summary found = summarise(run);
    text += where_to_begin(run, found);
    text += failures(run, found, folder);
    milestones += milestone_table(run, found);
  }
  text += milestones;
  text += clause_grid(report);
  if (!report.runs.empty()) text += all_results(report);
  text += system_table(report);
  return text + "</body></html>\n";
}

}  // namespace hmlfc::conform
