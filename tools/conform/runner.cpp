#include "conform/runner.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include <fnmatch.h>
#include <hmlfc/stream_info.hpp>

#include "conform/judge.hpp"
#include "conform/result.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::conform {

namespace fs = std::filesystem;

namespace {

// An empty folder, removed at the end unless kept.
class WorkFolder {
 public:
  explicit WorkFolder(fs::path path) : path_(std::move(path)) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::create_directories(path_, error_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }
  const std::error_code& error() const { return error_; }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  std::error_code error_;
  bool kept_ = false;
};

void fail_in_suite(VectorResult& result, std::string reason) {
  result.status = Status::kError;
  result.reason = std::move(reason);
}

// Whether a pattern with * and ? matches the vector's id, one of its clauses or one of its flags.
bool matches(const vectors::Vector& vector, const std::string& pattern) {
  const auto fits = [&](const std::string& text) {
    return ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
  };
  return fits(vector.id) || std::ranges::any_of(vector.clauses, fits) ||
         std::ranges::any_of(vector.flags, fits);
}

// Why vector number `index` of the manifest is left out; empty if it is not.
std::string why_left_out(const Selection& selection, const vectors::Vector& vector, size_t index) {
  const auto& filters = selection.filters;
  const auto fits = [&](const std::string& pattern) { return matches(vector, pattern); };
  if (!filters.empty() && std::ranges::none_of(filters, fits)) return "left out by --filter";
  if (index % selection.shards + 1 != selection.shard) {
    return fmt::format("not in shard {}/{}", selection.shard, selection.shards);
  }
  return {};
}

// One decoder on one suite.
class SuiteRun {
 public:
  SuiteRun(const Suite& suite, const Dut& dut, const RunOptions& options, fs::path folder)
      : suite_(suite), dut_(dut), options_(options), folder_(std::move(folder)) {}

  VectorResult result_of(size_t index) const {
    const vectors::Vector& vector = suite_.manifest.vectors[index];
    VectorResult result;
    result.id = vector.id;
    result.clauses = vector.clauses;
    result.comment = vector.comment;
    const fs::path input = fs::absolute(suite_.folder / vector.input.file);
    const auto file = io::MappedFile::open(input);
    if (!file) {
      fail_in_suite(result, file.error().message);
    } else if (vectors::sha256(file->bytes()) != vector.input.sha256) {
      fail_in_suite(result, "the stream is not the one of the manifest (SHA-256)");
    } else {
      run(vector, index, input, file->bytes(), result);
    }
    if (const Waiver* waiver = dut_.waiver(vector.id); waiver != nullptr && result.bad()) {
      result.waiver = waiver->reason;
    }
    return result;
  }

 private:
  void run(const vectors::Vector& vector, size_t index, const fs::path& input,
           std::span<const uint8_t> stream, VectorResult& result) const {
    const auto header = parse_header(stream);
    if (auto what =
            beyond_claims(dut_, vector.profile, vector.level, header ? &*header : nullptr)) {
      result.status = Status::kNotSupported;
      result.reason = *what;
      return;
    }
    result.reason = why_left_out(options_.selection, vector, index);
    if (!result.reason.empty()) return;
    WorkFolder work(folder_ / "work" / vector.id);
    if (work.error()) {
      return fail_in_suite(result, fmt::format("{}: cannot be created: {}", work.path().string(),
                                               work.error().message()));
    }
    const fs::path pictures = fs::path("failures") / vector.id;
    std::error_code ignored;
    fs::remove_all(folder_ / pictures, ignored);
    const Trial trial{dut_,
                      input,
                      stream,
                      work.path(),
                      options_.limits,
                      folder_ / pictures,
                      vector.blocks ? suite_.folder / vector.blocks->file : fs::path()};
    judge(trial, vector.expect, vector.output ? &*vector.output : nullptr, result);
    if (result.difference) result.pictures = (folder_.filename() / pictures).string();
    if (result.bad() && options_.keep) work.keep();
  }

  const Suite& suite_;
  const Dut& dut_;
  const RunOptions& options_;
  fs::path folder_;
};

}  // namespace

io::IoResult<Suite> open_suite(const std::filesystem::path& folder) {
  auto manifest = vectors::read_manifest(folder);
  if (!manifest) return tl::unexpected(manifest.error());
  const auto file = io::MappedFile::open(folder / "manifest.json");
  if (!file) return tl::unexpected(file.error());
  return Suite{folder, std::move(*manifest), vectors::sha256(file->bytes())};
}

std::string folder_name(const std::string& dut) {
  std::string name;
  for (const char c : dut) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "dut" : name.substr(0, 64);
}

io::IoResult<Run> run_suite(const Suite& suite, const Dut& dut, const RunOptions& options,
                            const io::Progress& progress) {
  const fs::path folder = fs::absolute(options.folder) / folder_name(dut.name);
  auto log = ResultLog::open(folder, suite.manifest_sha256, dut, options.resume);
  if (!log) return tl::unexpected(log.error());
  Run run{dut.name, dut.command, std::string(profile_name(dut.profile)), dut.level, {}};
  run.results.resize(suite.manifest.vectors.size());
  const SuiteRun suite_run(suite, dut, options, folder);
  std::mutex mutex;
  std::optional<io::IoError> first_error;
  io::for_each_index(run.results.size(), options.jobs, progress, [&](size_t index) {
    VectorResult& result = run.results[index];
    if (const VectorResult* earlier = log->earlier(suite.manifest.vectors[index].id)) {
      result = *earlier;
      return;
    }
    result = suite_run.result_of(index);
    const std::scoped_lock lock(mutex);
    if (auto written = log->append(result); !written && !first_error) {
      first_error = written.error();
    }
  });
  std::error_code ignored;
  if (!options.keep) fs::remove_all(folder / "work", ignored);
  if (first_error) return tl::unexpected(*first_error);
  return run;
}

VectorResult run_stream(const Dut& dut, std::span<const uint8_t> stream,
                        const std::filesystem::path& work, const ProcessLimits& limits) {
  VectorResult result;
  const WorkFolder folder(work);
  const fs::path input = folder.path() / "stream.hmlfc";
  const fs::path output = folder.path() / "output";
  std::error_code error = folder.error();
  if (!error) fs::create_directory(output, error);
  const auto written = io::write_file(input, stream);
  if (error || !written) {
    fail_in_suite(result, error ? error.message() : written.error().message);
    return result;
  }
  const auto header = parse_header(stream);
  if (header && beyond_claims(dut, header->profile, conformance_level(*header), &*header)) {
    result.status = Status::kNotSupported;
    return result;
  }
  vectors::Expectation expect;
  const auto golden = Decoder::open(stream);
  const auto decoded = golden ? golden->decode_all([](ViewPos, RgbImage&&) {}, {.threads = 1})
                              : tl::unexpected(golden.error());
  if (!decoded) {
    if (golden) expect.operation = vectors::Operation::kBlock;
    expect.outcome = vectors::Outcome::kReject;
    expect.error = decoded.error().code;
  }
  const Trial trial{dut, input, stream, output, limits, {}, {}};
  judge(trial, expect, nullptr, result);
  return result;
}

}  // namespace hmlfc::conform
