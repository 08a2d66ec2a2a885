// A decoder under test beside the golden model, for --dut.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "cli/view_source.hpp"
#include "conform/dut.hpp"
#include "conform/process.hpp"
#include "conform/running_dut.hpp"
#include "conform/work_folder.hpp"
#include "vectors/expected.hpp"

namespace hmlfc::view {

/// Asks a decoder under test about one stream, as the conformance runner does: a command line once
/// for all views, a decoder with the line protocol for each view and block. A process that fails is
/// started again for the next question. All functions may be called at the same time; the decoder
/// is asked one question after the other. Of a stream at an address it gets a copy, fetched before
/// the first question and removed at the end. SIGPIPE must be ignored.
class OtherDecoder {
 public:
  /// `stream`, open with the golden model, must outlive it. Starts nothing. Failure (kOutput): no
  /// folder for its files.
  OtherDecoder(conform::Dut dut, const conform::ProcessLimits& limits,
               const cli::StreamFile& stream);
  ~OtherDecoder();
  OtherDecoder(const OtherDecoder&) = delete;
  OtherDecoder& operator=(const OtherDecoder&) = delete;

  const std::string& name() const { return dut_.name; }

  /// For the end of the process, at any time: removes the decoder's files; what runs of it ends
  /// with the process. The questions after it fail.
  void end();

  /// View `view` of the grid, with all levels. Failure (kCorrupt): what the decoder says instead.
  RgbImage view(ViewPos view);

  /// The stages that it reports of a block, in its order; the block's samples alone where it gives
  /// no traces, nothing where it gives no blocks or not at this stop level. Failures: as for
  /// view().
  std::vector<vectors::RecordedStage> stages(const BlockAddress& block, int stop_level);

 private:
  struct Kept {
    ViewPos place;
    RgbImage image;
  };

  void copy_stream();
  RgbImage ask_for_view(ViewPos view);
  conform::RunningDut& running();
  template <class Question>
  auto asked(const std::string& what, const Question& question);

  conform::Dut dut_;
  conform::ProcessLimits limits_;
  const cli::StreamFile& stream_;
  const Decoder& golden_;  // of stream_
  std::atomic<bool> ended_ = false;
  std::mutex mutex_;
  conform::WorkFolder folder_;                    // for the copy and what a command line writes
  std::filesystem::path file_;                    // absolute; empty until there is a copy
  std::unique_ptr<conform::RunningDut> running_;  // with the stream open
  std::deque<Kept> kept_;                         // the views asked for last
};

}  // namespace hmlfc::view
