#include "conform/running_dut.hpp"

#include <utility>

#include "conform/command_decoder.hpp"
#include "conform/command_renderer.hpp"
#include "conform/line_decoder.hpp"

namespace hmlfc::conform {

std::unique_ptr<RunningDut> start(const Dut& dut, const ProcessLimits& limits,
                                  const std::filesystem::path& output, bool frames) {
  if (dut.waiting == nullptr && frames)
    return std::make_unique<CommandRenderer>(dut, limits, output);
  if (dut.waiting == nullptr) return std::make_unique<CommandDecoder>(dut, limits, output);
  return std::make_unique<LineDecoder>(dut.command, limits);
}

// Nobody asks a decoder for what it cannot do.
[[noreturn]] static void not_asked() {
  throw DutFailure{Status::kError, "the decoder is not asked for this"};
}

DutAnswer<RgbImage> RunningDut::view(ViewPos) { not_asked(); }

DutAnswer<std::vector<int32_t>> RunningDut::block(const BlockAddress&, int) { not_asked(); }

DutAnswer<std::string> RunningDut::trace(const BlockAddress&, int) { not_asked(); }

DutAnswer<std::vector<int32_t>> RunningDut::record(const hmlfc_dut_camera&) { not_asked(); }

DutAnswer<DutFrame> RunningDut::frame(const vectors::FrameCase&) { not_asked(); }

DutAnswer<std::vector<BlockDisparity>> RunningDut::map(ViewPos, size_t) { not_asked(); }

DutAnswer<std::string> RunningDut::pixel(const vectors::FrameCase&, uint32_t, uint32_t) {
  not_asked();
}

std::unique_ptr<RunningDut> WaitingDuts::take() {
  const std::scoped_lock lock(mutex_);
  if (waiting_.empty()) return nullptr;
  auto process = std::move(waiting_.back());
  waiting_.pop_back();
  return process;
}

void WaitingDuts::give_back(std::unique_ptr<RunningDut> process) {
  const std::scoped_lock lock(mutex_);
  waiting_.push_back(std::move(process));
}

bool WaitingDuts::is_run_again() {
  constexpr unsigned kEnough = 8;
  const std::scoped_lock lock(mutex_);
  return run_again_++ < kEnough;
}

}  // namespace hmlfc::conform
