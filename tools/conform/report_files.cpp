#include "conform/report_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "conform/report_json.hpp"
#include "io/atomic_file.hpp"

namespace hmlfc::conform {
namespace {

namespace fs = std::filesystem;

io::IoResult<void> write_text(const fs::path& file, const std::string& text) {
  return io::write_file(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// Skipped says less than any result; of results the worse one counts.
int weight(Status status) {
  switch (status) {
    case Status::kSkipped:
      return 0;
    case Status::kNotSupported:
      return 1;
    case Status::kPass:
      return 2;
    case Status::kTimeout:
      return 3;
    case Status::kError:
      return 4;
    case Status::kFail:
      return 5;
  }
  return 0;
}

io::IoResult<void> copy_pictures(const Run& run, const fs::path& from, const fs::path& to) {
  for (const VectorResult& result : run.results) {
    if (result.pictures.empty() || fs::weakly_canonical(from) == fs::weakly_canonical(to)) continue;
    std::error_code error;
    fs::create_directories(to / result.pictures, error);
    if (!error) {
      fs::copy(from / result.pictures, to / result.pictures,
               fs::copy_options::overwrite_existing | fs::copy_options::recursive, error);
    }
    if (error) return io::system_error(to / result.pictures, "cannot be copied", error.value());
  }
  return {};
}

void merge_run(Run& into, const Run& run) {
  for (size_t i = 0; i < into.results.size(); ++i) {
    if (weight(run.results[i].status) > weight(into.results[i].status)) {
      into.results[i] = run.results[i];
    }
  }
}

bool same_vectors(const Run& a, const Run& b) {
  return std::ranges::equal(a.results, b.results, {}, &VectorResult::id, &VectorResult::id);
}

}  // namespace

io::IoResult<void> write_report(const Report& report, const fs::path& folder) {
  const std::string json =
      to_json(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (auto done = write_text(folder / "report.json", json); !done) return done;
  if (auto done = write_text(folder / "junit.xml", junit_text(report)); !done) return done;
  return write_text(folder / "report.html", html_text(report, folder));
}

io::IoResult<Report> merge(const std::vector<ReportPart>& parts, const fs::path& folder) {
  if (parts.empty()) return tl::unexpected(io::IoError{"no reports to merge"});
  Report merged = parts.front().report;
  merged.runs.clear();
  for (const ReportPart& part : parts) {
    if (part.report.manifest_sha256 != merged.manifest_sha256) {
      return io::file_error(part.folder,
                            "is a report on another suite than " + parts.front().folder.string());
    }
    for (const Run& run : part.report.runs) {
      if (auto copied = copy_pictures(run, part.folder, folder); !copied) {
        return tl::unexpected(copied.error());
      }
      const auto found = std::ranges::find(merged.runs, run.dut, &Run::dut);
      if (found == merged.runs.end()) {
        merged.runs.push_back(run);
      } else if (same_vectors(*found, run)) {
        merge_run(*found, run);
      }
    }
    if (!merged.runs.empty() && !same_vectors(merged.runs.front(), merged.runs.back())) {
      return io::file_error(part.folder, "has other vectors than the other reports");
    }
  }
  return merged;
}

}  // namespace hmlfc::conform
