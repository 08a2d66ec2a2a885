#include "conform/report.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conform/report_folder.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

namespace fs = std::filesystem;

namespace {

// The first value of "model name : ..." in /proc/cpuinfo.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(std::min(colon + 2, line.size()));
    }
  }
  return "unknown";
}

io::IoResult<void> write_text(const fs::path& folder, const char* name, const std::string& text) {
  const auto file = path_inside(folder, name);
  if (!file) return tl::unexpected(file.error());
  return io::write_file(*file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// Of two results the worse counts, and any counts more than skipped.
int weight(Status status) {
  constexpr int kWeights[kStatusCount] = {2, 5, 4, 3, 1, 0};  // by status
  return kWeights[static_cast<size_t>(status)];
}

// The run of a decoder, put together, and the folder of the report that each result is from.
struct Merged {
  Run run;
  std::vector<const fs::path*> folders;
};

void merge_run(Merged& into, const Run& run, const fs::path& folder) {
  if (run.milestone != into.run.milestone) into.run.milestone.clear();
  for (size_t i = 0; i < into.run.results.size(); ++i) {
    if (weight(run.results[i].status) > weight(into.run.results[i].status)) {
      into.run.results[i] = run.results[i];
      into.folders[i] = &folder;
    }
  }
}

bool same_vectors(const Run& a, const Run& b) {
  return std::ranges::equal(a.results, b.results, {}, &VectorResult::id, &VectorResult::id);
}

// Adds the runs of a part. Errors: as for merge().
io::IoResult<void> add_part(std::vector<Merged>& merged, const ReportPart& part) {
  for (const Run& run : part.report.runs) {
    if (!merged.empty() && !same_vectors(merged.front().run, run)) {
      return io::file_error(part.folder, "has other vectors than the other reports");
    }
    const auto name_of = [](const Merged& one) { return folder_name(one.run.dut); };
    const auto found = std::ranges::find(merged, folder_name(run.dut), name_of);
    if (found == merged.end()) {
      merged.push_back({run, std::vector(run.results.size(), &part.folder)});
    } else if (found->run.dut == run.dut) {
      merge_run(*found, run, part.folder);
    } else {
      return io::file_error(part.folder, "its decoder " + run.dut + " has the folder of " +
                                             found->run.dut + "; give one another name");
    }
  }
  return {};
}

// Copies the pictures of all results into `folder`.
io::IoResult<void> gather_pictures(const Merged& merged, const fs::path& folder) {
  for (size_t i = 0; i < merged.folders.size(); ++i) {
    const std::string& pictures = merged.run.results[i].pictures;
    std::error_code ignored;
    if (pictures.empty() || fs::equivalent(*merged.folders[i], folder, ignored)) continue;
    if (auto copied = copy_pictures(*merged.folders[i], folder, pictures); !copied) return copied;
  }
  return {};
}

}  // namespace

SystemInfo this_system(const std::string& program) {
  utsname name{};
  ::uname(&name);
  const auto pages = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page = static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
  return {program,
          fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          fmt::format("{} {} {}", name.sysname, name.release, name.machine),
          processor_name(),
          std::thread::hardware_concurrency(),
          pages * page >> 20};
}

io::IoResult<void> write_report(const Report& report, const fs::path& folder) {
  const std::string json = io::json_text(to_json(report), 2) + "\n";
  if (auto done = write_text(folder, "report.json", json); !done) return done;
  if (auto done = write_text(folder, "junit.xml", junit_text(report)); !done) return done;
  return write_text(folder, "report.html", html_text(report, folder));
}

io::IoResult<Report> merge(const std::vector<ReportPart>& parts, const fs::path& folder) {
  if (parts.empty()) return tl::unexpected(io::IoError{"no reports to merge"});
  Report merged = parts.front().report;
  merged.runs.clear();
  std::vector<Merged> runs;
  for (const ReportPart& part : parts) {
    if (part.report.manifest_sha256 != merged.manifest_sha256) {
      return io::file_error(part.folder,
                            "reports on another suite than " + parts.front().folder.string());
    }
    if (auto added = add_part(runs, part); !added) return tl::unexpected(added.error());
  }
  for (Merged& one : runs) {
    if (auto done = gather_pictures(one, folder); !done) return tl::unexpected(done.error());
    merged.runs.push_back(std::move(one.run));
  }
  return merged;
}

}  // namespace hmlfc::conform
