#include "conform/runner.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "conform/block_commands.hpp"
#include "conform/judge.hpp"
#include "conform/result.hpp"
#include "conform/work_folder.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::conform {

namespace fs = std::filesystem;

namespace {

void fail_in_suite(VectorResult& result, std::string reason) {
  result.status = Status::kError;
  result.reason = std::move(reason);
}

// Why vector number `index` of the manifest is left out; empty if it is not.
std::string why_left_out(const Selection& selection, const vectors::Vector& vector, size_t index) {
  const auto& filters = selection.filters;
  const auto fits = [&](const std::string& pattern) { return vectors::matches(vector, pattern); };
  if (!filters.empty() && std::ranges::none_of(filters, fits)) return "left out by --filter";
  if (!selection.milestone.empty() && vector.milestone != selection.milestone) {
    return "left out by --milestone";
  }
  if (index % selection.shards + 1 != selection.shard) {
    return fmt::format("not in shard {}/{}", selection.shard, selection.shards);
  }
  return {};
}

// Why each vector is left out; empty where it is run, for itself or as the base of another.
std::vector<std::string> reasons_to_leave_out(const Selection& selection,
                                              const std::vector<vectors::Vector>& all) {
  std::vector<std::string> reasons;
  std::set<std::string> bases;
  for (size_t i = 0; i < all.size(); ++i) {
    reasons.push_back(why_left_out(selection, all[i], i));
    if (reasons.back().empty() && all[i].base) bases.insert(*all[i].base);
  }
  for (size_t i = 0; i < all.size(); ++i) {
    if (bases.contains(all[i].id)) reasons[i].clear();
  }
  return reasons;
}

// Whether its failure shows more than that there is one: in several views and blocks, of a stream
// that is neither extreme nor damaged.
bool is_telling(const vectors::Vector& vector, const StreamHeader& header) {
  const uint32_t side = 2 * header.block_size();
  return (vector.group == "syntax" || vector.group == "real") && header.rows * header.cols > 1 &&
         header.width >= side && header.height >= side;
}

// A refusal that is right by itself counts only if the stream that it is made from passes.
void settle_base(const VectorResult& base, const Waiver* waiver, VectorResult& result) {
  if (result.status != Status::kPass || base.status == Status::kPass) return;
  result.status = base.bad() ? Status::kFail : base.status;
  result.not_counted = base.bad();
  result.reason = fmt::format("not counted: the result of its base {} is {}", base.id,
                              status_name(base.status));
  result.inspect = base.inspect;
  result.view = base.view;
  result.waiver = waiver != nullptr && base.bad() ? waiver->reason : base.waiver;
}

void settle_bases(const vectors::Manifest& manifest, const Dut& dut, Run& run) {
  std::map<std::string, const VectorResult*> by_id;
  for (VectorResult& result : run.results) {
    const Waiver* waiver = dut.waiver(result.id);
    if (waiver != nullptr && result.bad()) result.waiver = waiver->reason;
    by_id[result.id] = &result;
  }
  for (size_t i = 0; i < run.results.size(); ++i) {
    const auto& base = manifest.vectors[i].base;
    if (base) settle_base(*by_id.at(*base), dut.waiver(run.results[i].id), run.results[i]);
  }
}

// One decoder on one suite.
class SuiteRun {
 public:
  SuiteRun(const Suite& suite, const Dut& dut, const RunOptions& options, fs::path folder)
      : suite_(suite),
        dut_(dut),
        options_(options),
        folder_(std::move(folder)),
        left_out_(reasons_to_leave_out(options.selection, suite.manifest.vectors)) {}

  VectorResult result_of(size_t index) const {
    const vectors::Vector& vector = suite_.manifest.vectors[index];
    VectorResult result;
    result.id = vector.id;
    result.clauses = vector.clauses;
    result.comment = vector.comment;
    result.milestone = vector.milestone;
    result.bytes = vector.input.bytes;
    const fs::path input = fs::absolute(suite_.folder / vector.input.file);
    const auto file = io::map_file(input);
    if (!file) {
      fail_in_suite(result, file.error().message);
    } else if (vectors::sha256(file->bytes()) != vector.input.sha256) {
      fail_in_suite(result, "the stream is not the one of the manifest (SHA-256)");
    } else {
      run(vector, index, input, file->bytes(), result);
    }
    if (!result.bad()) return result;
    result.inspect = inspect_command(suite_, vector, result);
    result.view = view_command(suite_, vector, dut_, result);
    return result;
  }

 private:
  void run(const vectors::Vector& vector, size_t index, const fs::path& input,
           std::span<const uint8_t> stream, VectorResult& result) const {
    const auto header = parse_header(stream);
    result.telling = header && is_telling(vector, *header);
    if (auto what =
            beyond_claims(dut_, vector.profile, vector.level, header ? &*header : nullptr)) {
      result.status = Status::kNotSupported;
      result.reason = *what;
      return;
    }
    result.reason = left_out_[index];
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
  std::vector<std::string> left_out_;
};

}  // namespace

io::IoResult<Suite> open_suite(const std::filesystem::path& folder) {
  auto manifest = vectors::read_manifest(folder);
  if (!manifest) return tl::unexpected(manifest.error());
  const auto file = io::map_file(folder / "manifest.json");
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
  Run run{dut.name,
          dut.command,
          std::string(profile_name(dut.profile)),
          dut.level,
          options.selection.milestone,
          {}};
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
  settle_bases(suite.manifest, dut, run);
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
