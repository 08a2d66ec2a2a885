#include "conform/result.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "conform/report.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

namespace {

constexpr io::JsonLimits kResultLimits{"a result", size_t{1} << 24, 3};

// Null where the line is no JSON text.
Json read_line(const std::string& line) {
  return io::parse_json<Json>({reinterpret_cast<const uint8_t*>(line.data()), line.size()},
                              kResultLimits)
      .value_or(Json());
}

io::IoResult<void> write_line(const std::filesystem::path& path, const io::FileDescriptor& file,
                              std::string line) {
  line += '\n';
  const ssize_t written = ::write(file.get(), line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size())) {
    return io::system_error(path, "cannot be written", written < 0 ? errno : ENOSPC);
  }
  return {};
}

}  // namespace

Tally tally(const Run& run) {
  Tally tally;
  for (const VectorResult& result : run.results) {
    if (result.waived()) {
      ++tally.waived;
    } else {
      ++tally.count[static_cast<size_t>(result.status)];
    }
  }
  return tally;
}

Verdict verdict(const Run& run) {
  if (tally(run).bad() != 0) return Verdict::kFails;
  const auto has = [&](Status status) {
    return std::ranges::any_of(run.results, [&](const VectorResult& result) {
      return result.status == status &&
             (run.milestone.empty() || result.milestone == run.milestone);
    });
  };
  if (!has(Status::kPass) || has(Status::kSkipped)) return Verdict::kIncomplete;
  return run.milestone.empty() ? Verdict::kConforms : Verdict::kWhole;
}

std::string verdict_text(const Run& run) {
  const Verdict found = verdict(run);
  if (found == Verdict::kFails) return "fails";
  if (found == Verdict::kIncomplete) return "incomplete";
  const std::string text =
      found == Verdict::kConforms ? "conforms" : "milestone " + run.milestone + " is whole";
  return tally(run).waived == 0 ? text : text + ", with waivers";
}

io::IoResult<ResultLog> ResultLog::open(const std::filesystem::path& folder,
                                        const std::string& manifest_sha256, const Dut& dut,
                                        bool resume) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return io::system_error(folder, "cannot be created", error.value());
  ResultLog log;
  log.path_ = folder / "results.jsonl";
  const Json head = {
      {"manifest_sha256", manifest_sha256}, {"dut", dut.name}, {"command", dut.command}};
  bool begun = false;
  if (resume) {
    std::ifstream stream(log.path_);
    std::string line;
    if (std::getline(stream, line)) {
      begun = true;
      if (line != io::json_text(head)) {
        return io::file_error(log.path_,
                              "has results of another suite or decoder; leave out --resume to "
                              "start again");
      }
    }
    while (std::getline(stream, line)) {
      auto result = result_from_json(read_line(line), dut.name);
      if (result && result->status != Status::kSkipped) log.earlier_[result->id] = *result;
    }
  }
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (begun ? O_APPEND : O_TRUNC);
  log.file_ = io::FileDescriptor(::open(log.path_.c_str(), flags, 0666));
  if (log.file_.get() < 0) return io::system_error(log.path_, "cannot be written", errno);
  // An interrupted run may have left half a line: an empty write ends it.
  auto written = write_line(log.path_, log.file_, begun ? std::string() : io::json_text(head));
  if (!written) return tl::unexpected(written.error());
  return log;
}

const VectorResult* ResultLog::earlier(const vectors::VectorId& id) const {
  const auto found = earlier_.find(id);
  return found == earlier_.end() ? nullptr : &found->second;
}

io::IoResult<void> ResultLog::append(const VectorResult& result) {
  return write_line(path_, file_, io::json_text(to_json(result)));
}

}  // namespace hmlfc::conform
