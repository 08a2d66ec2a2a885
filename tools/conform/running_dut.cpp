#include "conform/running_dut.hpp"

#include <utility>

#include "conform/command_decoder.hpp"
#include "conform/line_decoder.hpp"

namespace hmlfc::conform {

std::unique_ptr<RunningDut> start(const Dut& dut, const ProcessLimits& limits,
                                  const std::filesystem::path& output) {
  if (dut.waiting == nullptr) return std::make_unique<CommandDecoder>(dut, limits, output);
  return std::make_unique<LineDecoder>(dut.command, limits);
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
