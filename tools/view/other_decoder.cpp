#include "view/other_decoder.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/output.hpp"
#include "conform/judge.hpp"
#include "conform/output_views.hpp"
#include "conform/stage_trace.hpp"
#include "conform/view_assembly.hpp"
#include "io/files.hpp"
#include "syntax/geometry.hpp"
#include "view/guard.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;

namespace {

constexpr size_t kKeptViews = 4;
constexpr uint64_t kCopiedBytes = uint64_t{64} << 20;  // at a time

Failure failure_of(const std::string& decoder, const std::string& what, const std::string& why) {
  return {ExitCode::kCorrupt, fmt::format("{}: {}: {}", decoder, what, why)};
}

// The site of a block's own stages at its stop level.
BlockSite site_of(const StreamHeader& header, const BlockAddress& block, int stop_level) {
  const ImagePos image = Geometry(header).ancestor({block.view.row, block.view.col}, 0, stop_level);
  return {stop_level, image.row, image.col, block.plane, block.bx, block.by};
}

}  // namespace

OtherDecoder::OtherDecoder(conform::Dut dut, const conform::ProcessLimits& limits,
                           const cli::StreamFile& stream)
    : dut_(std::move(dut)),
      limits_(limits),
      stream_(stream),
      golden_(stream.decoder()),
      folder_(std::filesystem::temp_directory_path() / ("hmlfc-view-" + random_token())) {
  if (folder_.error()) {
    throw Failure(ExitCode::kOutput,
                  fmt::format("{}: {}", folder_.path().string(), folder_.error().message()));
  }
}

OtherDecoder::~OtherDecoder() = default;

void OtherDecoder::end() {
  ended_ = true;
  std::error_code ignored;
  std::filesystem::remove_all(folder_.path(), ignored);
}

// Copies the stream, whose own file no decoder gets, unless that is done. Failure: as for
// StreamFile::with_bytes, or there is no room for it.
void OtherDecoder::copy_stream() {
  if (!file_.empty()) return;
  const std::filesystem::path path = folder_.path() / "stream.hmlfc";
  auto copy = cli::value_or_throw(io::AtomicFile::create(path), ExitCode::kInput);
  for (uint64_t at = 0; at < stream_.size(); at += kCopiedBytes) {
    const ByteRange range{at, std::min(kCopiedBytes, stream_.size() - at)};
    stream_.with_bytes(range, [&copy](std::span<const uint8_t> bytes) {
      cli::value_or_throw(copy.write(bytes), ExitCode::kInput);
    });
  }
  cli::value_or_throw(copy.commit(), ExitCode::kInput);
  file_ = path;
}

// The process, with the stream open. Throws LineFailure, and std::string where it refuses the
// stream.
conform::LineDecoder& OtherDecoder::line() {
  if (line_ == nullptr) {
    auto started = std::make_unique<conform::LineDecoder>(dut_.command, limits_);
    const auto geometry = started->open(file_);
    if (!geometry) throw Failure(ExitCode::kCorrupt, geometry.error());
    if (const auto wrong = conform::wrong_geometry(golden_.header(), *geometry)) {
      throw Failure(ExitCode::kCorrupt, *wrong);
    }
    line_ = std::move(started);
  }
  line_->allow(limits_.seconds);
  return *line_;
}

// The views that a command line writes.
const std::vector<RgbImage>& OtherDecoder::output() {
  if (output_) return *output_;
  const conform::WorkFolder folder(folder_.path() / "views");
  if (folder.error()) throw Failure(ExitCode::kCorrupt, folder.error().message());
  const conform::Places places{{"input", file_.string()}, {"output", folder.path().string()}};
  const auto outcome = conform::run_process(conform::fill_in(dut_.command, places), limits_);
  if (outcome.end != conform::ProcessEnd::kExit || outcome.value != 0) {
    throw Failure(ExitCode::kCorrupt, to_string(outcome) + conform::last_words(outcome.messages));
  }
  output_ = cli::value_or_throw(
      conform::read_output_views(folder.path(), cli::shape_of(golden_.header())),
      ExitCode::kCorrupt);
  return *output_;
}

// The answer to a question; a decoder that does not answer ends, and is named.
template <class Question>
auto OtherDecoder::asked(const std::string& what, const Question& question) {
  if (ended_) throw failure_of(name(), what, "hmlfc view ends");
  copy_stream();
  try {
    return question();
  } catch (const conform::LineFailure& failed) {
    line_.reset();
    throw failure_of(name(), what, failed.reason);
  } catch (const std::system_error& error) {
    line_.reset();
    throw failure_of(name(), what, error.what());
  } catch (const Failure& failure) {
    throw failure_of(name(), what, failure.what());
  }
}

RgbImage OtherDecoder::ask_for_view(ViewPos view) {
  if (dut_.lines == nullptr) return output()[size_t{view.row} * golden_.header().cols + view.col];
  conform::LineDecoder& decoder = line();
  auto image = decoder.views() && !dut_.by_block
                   ? decoder.view(view)
                   : conform::assemble_view(golden_, view, [&decoder](const BlockAddress& block) {
                       return decoder.block(block, 0);
                     });
  if (!image) throw Failure(ExitCode::kCorrupt, image.error());
  return std::move(*image);
}

RgbImage OtherDecoder::view(ViewPos view) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(kept_, [view](const Kept& kept) {
    return kept.place.row == view.row && kept.place.col == view.col;
  });
  if (found != kept_.end()) return found->image;
  RgbImage image = asked(fmt::format("view {},{}", view.row, view.col),
                         [this, view] { return ask_for_view(view); });
  kept_.push_back({view, image});
  if (kept_.size() > kKeptViews) kept_.pop_front();
  return image;
}

std::vector<vectors::RecordedStage> OtherDecoder::stages(const BlockAddress& block,
                                                         int stop_level) {
  const std::lock_guard lock(mutex_);
  const std::string what =
      fmt::format("block {},{} of view {},{}", block.bx, block.by, block.view.row, block.view.col);
  return asked(what, [&]() -> std::vector<vectors::RecordedStage> {
    if (dut_.lines == nullptr) {
      if (dut_.trace.empty() || stop_level != 0) return {};
      const auto text = conform::trace_by_command(dut_, file_, block, limits_);
      if (!text) throw Failure(ExitCode::kCorrupt, text.error());
      return conform::parse_stages(*text);
    }
    conform::LineDecoder& decoder = line();
    if (stop_level != 0 && !decoder.levels()) return {};
    if (decoder.traces()) {
      const auto text = decoder.trace(block, stop_level);
      if (!text) throw Failure(ExitCode::kCorrupt, text.error());
      return conform::parse_stages(*text);
    }
    if (!decoder.blocks()) return {};
    auto samples = decoder.block(block, stop_level);
    if (!samples) throw Failure(ExitCode::kCorrupt, samples.error());
    return {{site_of(golden_.header(), block, stop_level), "sample", "", std::move(*samples)}};
  });
}

}  // namespace hmlfc::view
