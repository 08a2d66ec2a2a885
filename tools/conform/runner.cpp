#include "conform/runner.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "conform/block_commands.hpp"
#include "conform/judge.hpp"
#include "conform/report_folder.hpp"
#include "conform/result.hpp"
#include "conform/work_folder.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"
#include "vectors/frame_vector.hpp"
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
  std::set<vectors::VectorId> bases;
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
// that is neither extreme nor damaged; or in the stream to begin with.
bool is_telling(const vectors::Vector& vector, const StreamHeader& header) {
  if (std::ranges::find(vector.flags, "to-begin-with") != vector.flags.end()) return true;
  const uint32_t side = 2 * header.block_size();
  return (vector.group == "syntax" || vector.group == "real") && header.rows * header.cols > 1 &&
         header.width >= side && header.height >= side;
}

// Why a frame or map is beyond what the renderer claims; nothing if it is not, or for a vector.
std::optional<std::string> beyond_renderer(const Claims& claims,
                                           const std::optional<vectors::FrameCase>& frame) {
  if (!frame) return std::nullopt;
  const bool geometry =
      frame->map || (frame->record && frame_record_of(frame->record->data()).geometry != 0);
  if (geometry && !claims.geometry) return "profile geometry";
  if (!frame->frame) return std::nullopt;
  if (frame->frame->width > claims.frame_width || frame->frame->height > claims.frame_height) {
    return fmt::format("frame of {} x {}", frame->frame->width, frame->frame->height);
  }
  return std::nullopt;
}

// A refusal that is right by itself counts only if the stream that it is made from passes.
void settle_base(const VectorResult& base, const Waiver* waiver, VectorResult& result) {
  if (result.status != Status::kPass || base.status == Status::kPass) return;
  result.status = base.bad() ? Status::kFail : base.status;
  result.not_counted = base.bad();
  result.reason = fmt::format("not counted: the result of its base {} is {}", base.id.text(),
                              status_name(base.status));
  result.inspect = base.inspect;
  result.view = base.view;
  result.waiver = waiver != nullptr && base.bad() ? waiver->reason : base.waiver;
}

void settle_bases(const vectors::Manifest& manifest, const Dut& dut, Run& run) {
  std::map<vectors::VectorId, const VectorResult*> by_id;
  for (VectorResult& result : run.results) {
    const Waiver* waiver = dut.waiver(result.id.text());
    if (waiver != nullptr && result.bad()) result.waiver = waiver->reason;
    by_id[result.id] = &result;
  }
  for (size_t i = 0; i < run.results.size(); ++i) {
    const auto& base = manifest.vectors[i].base;
    if (base) settle_base(*by_id.at(*base), dut.waiver(run.results[i].id.text()), run.results[i]);
  }
}

// One decoder on one suite, whose files it never sees: each run gets a copy of the stream.
class SuiteRun {
 public:
  // `work`: for the files of runs.
  SuiteRun(const Suite& suite, const Dut& dut, const RunOptions& options, fs::path work)
      : suite_(suite),
        dut_(dut),
        options_(options),
        work_(std::move(work)),
        left_out_(reasons_to_leave_out(options.selection, suite.manifest.vectors)) {}

  VectorResult result_of(size_t index) const {
    const vectors::Vector& vector = suite_.manifest.vectors[index];
    VectorResult result;
    result.id = vector.id;
    result.clauses = vector.clauses;
    result.comment = vector.comment;
    result.milestone = vector.milestone;
    result.bytes = vector.input.bytes;
    try {
      run(vector, index, result);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      fail_in_suite(result, error.what());
    }
    if (!result.bad()) return result;
    result.inspect = inspect_command(suite_, vector, result);
    result.view = view_command(suite_, vector, dut_, result);
    return result;
  }

 private:
  void run(const vectors::Vector& vector, size_t index, VectorResult& result) const {
    const auto file = io::map_file(suite_.folder / vector.input.file);
    if (!file) return fail_in_suite(result, file.error().message);
    if (vectors::sha256(file->bytes()) != vector.input.sha256) {
      return fail_in_suite(result, "the stream is not the one of the manifest (SHA-256)");
    }
    const auto header = parse_header(file->bytes());
    result.telling = header && is_telling(vector, *header);
    if (auto what =
            beyond(dut_.claims, vector.profile, vector.level, header ? &*header : nullptr)) {
      result.status = Status::kNotSupported;
      result.reason = *what;
      return;
    }
    if (auto what = beyond_renderer(dut_.claims, vector.frame)) {
      result.status = Status::kNotSupported;
      result.reason = *what;
      return;
    }
    result.reason = left_out_[index];
    if (result.reason.empty()) run_decoder(vector, file->bytes(), result);
  }

  void run_decoder(const vectors::Vector& vector, std::span<const uint8_t> stream,
                   VectorResult& result) const {
    const fs::path work = work_ / vector.id;
    const fs::path pictures = pictures_of(dut_.name, vector.id);
    const auto shown = path_inside(options_.folder, pictures);
    if (!shown) return fail_in_suite(result, shown.error().message);
    remove_pictures(*shown);
    fs::create_directories(work / "output");
    judge({dut_, work / "stream.hmlfc", stream, work / "output", options_.limits, vector.expect,
           vector.output ? &*vector.output : nullptr, *shown,
           vector.blocks ? suite_.folder / vector.blocks->file : fs::path(),
           vector.frame ? &*vector.frame : nullptr},
          result);
    if (result.difference) result.pictures = pictures.string();
    remove_tree(work);
  }

  const Suite& suite_;
  const Dut& dut_;
  const RunOptions& options_;
  fs::path work_;
  std::vector<std::string> left_out_;
};

// A folder for the runs of a decoder in the folder of its results. Errors: it cannot be created.
io::IoResult<std::unique_ptr<WorkFolder>> new_work_folder(const fs::path& prefix) {
  auto folder = std::make_unique<WorkFolder>(fs::absolute(prefix));
  if (!folder->error()) return folder;
  return io::system_error(folder->path(), "cannot be created", folder->error().value());
}

}  // namespace

io::IoResult<Suite> open_suite(const std::filesystem::path& folder, bool frames) {
  auto manifest = vectors::read_manifest(folder);
  if (!manifest) return tl::unexpected(manifest.error());
  const auto file = io::map_file(folder / "manifest.json");
  if (!file) return tl::unexpected(file.error());
  if (frames && manifest->frames.empty()) {
    return io::file_error(folder, "has no frames: suites have them since version 3.4.0");
  }
  return Suite{folder, frames ? vectors::frames_of(std::move(*manifest)) : std::move(*manifest),
               frames, vectors::sha256(file->bytes())};
}

io::IoResult<Run> run_suite(const Suite& suite, const Dut& dut, const RunOptions& options,
                            const io::Progress& progress) {
  const auto folder = path_inside(options.folder, folder_name(dut.name));
  if (!folder) return tl::unexpected(folder.error());
  auto log = ResultLog::open(*folder, suite.manifest_sha256, dut, options.resume);
  if (!log) return tl::unexpected(log.error());
  const auto work = new_work_folder(*folder / "work");
  if (!work) return tl::unexpected(work.error());
  Run run{dut.name,
          dut.command,
          std::string(profile_name(dut.claims.profile)),
          dut.claims.level,
          options.selection.milestone,
          {}};
  run.results.resize(suite.manifest.vectors.size());
  const SuiteRun suite_run(suite, dut, options, (*work)->path());
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
  if (first_error) return tl::unexpected(*first_error);
  settle_bases(suite.manifest, dut, run);
  return run;
}

// What the golden model says of all views of a stream.
static vectors::Expectation expect_views(std::span<const uint8_t> stream) {
  vectors::Expectation expect;
  const auto golden = Decoder::open(stream);
  const auto decoded = golden ? golden->decode_all([](ViewPos, RgbImage&&) {}, {.threads = 1})
                              : tl::unexpected(golden.error());
  if (decoded) return expect;
  if (golden) expect.operation = vectors::Operation::kBlock;
  expect.outcome = vectors::Outcome::kReject;
  expect.error = decoded.error().code;
  return expect;
}

VectorResult run_stream(const Dut& dut, std::span<const uint8_t> stream,
                        const std::filesystem::path& work, const ProcessLimits& limits,
                        const std::optional<vectors::FrameCase>& frame) {
  VectorResult result;
  const auto folder = new_work_folder(work);
  if (!folder) {
    fail_in_suite(result, folder.error().message);
    return result;
  }
  const fs::path output = (*folder)->path() / "output";
  std::error_code failure;
  if (!fs::create_directory(output, failure)) {
    fail_in_suite(result, failure.message());
    return result;
  }
  const auto header = parse_header(stream);
  auto asked = frame;
  vectors::Expectation expect;
  if (asked) {
    const auto golden = Decoder::open(stream);
    const StreamHeader* shape = golden ? &golden->header() : nullptr;
    if (shape == nullptr || asked->stop_level > shape->tree_height ||
        (asked->map &&
         (asked->map->view.row >= shape->rows || asked->map->view.col >= shape->cols))) {
      result.status = Status::kNotSupported;
      result.reason = "the stream does not open, or has no such view or level";
      return result;
    }
    expect = vectors::expect_frame(*golden, *asked);
  } else {
    expect = expect_views(stream);
  }
  if ((header && beyond(dut.claims, header->profile, conformance_level(*header), &*header)) ||
      beyond_renderer(dut.claims, asked)) {
    result.status = Status::kNotSupported;
    return result;
  }
  const auto input = (*folder)->path() / "stream.hmlfc";
  judge({dut, input, stream, output, limits, expect, nullptr, {}, {}, asked ? &*asked : nullptr},
        result);
  return result;
}

}  // namespace hmlfc::conform
