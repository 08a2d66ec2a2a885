#include "view/other_decoder.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/output.hpp"
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
  conform::remove_tree(folder_.path());
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

// The decoder, with the stream open. Throws DutFailure, and Failure where it refuses the stream.
conform::RunningDut& OtherDecoder::running() {
  if (running_ == nullptr) {
    const auto output = folder_.path() / "views";
    conform::remove_tree(output);
    std::filesystem::create_directory(output);
    auto started = conform::start(dut_, limits_, output);
    const auto geometry = started->open(file_);
    if (!geometry) throw Failure(ExitCode::kCorrupt, geometry.error());
    if (const auto wrong = conform::wrong_geometry(golden_.header(), *geometry)) {
      throw Failure(ExitCode::kCorrupt, *wrong);
    }
    running_ = std::move(started);
  }
  running_->allow(limits_.seconds);
  return *running_;
}

// The answer to a question; a decoder that does not answer ends, and is named.
template <class Question>
auto OtherDecoder::asked(const std::string& what, const Question& question) {
  if (ended_) throw failure_of(name(), what, "hmlfc view ends");
  copy_stream();
  try {
    return question();
  } catch (const conform::DutFailure& failed) {
    running_.reset();
    throw failure_of(name(), what, failed.reason);
  } catch (const std::system_error& error) {
    running_.reset();
    throw failure_of(name(), what, error.what());
  } catch (const Failure& failure) {
    throw failure_of(name(), what, failure.what());
  }
}

RgbImage OtherDecoder::ask_for_view(ViewPos view) {
  auto image = conform::view_of(running(), dut_.by_block, golden_, view);
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
    conform::RunningDut& decoder = running();
    if (stop_level != 0 && !decoder.can().levels) return {};
    if (decoder.can().traces) {
      const auto text = decoder.trace(block, stop_level);
      if (!text) throw Failure(ExitCode::kCorrupt, text.error());
      return conform::parse_stages(*text);
    }
    if (!decoder.can().blocks) return {};
    auto samples = decoder.block(block, stop_level);
    if (!samples) throw Failure(ExitCode::kCorrupt, samples.error());
    return {{site_of(golden_.header(), block, stop_level), "sample", "", std::move(*samples)}};
  });
}

}  // namespace hmlfc::view
