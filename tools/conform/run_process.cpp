// What of process.hpp is the same on every system.
#include <chrono>
#include <utility>

#include "conform/process.hpp"

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kOutputBytes = size_t{16} << 20;

}  // namespace

void Process::Tail::cut() {
  if (text.size() > keep) text.erase(0, text.size() - keep);
}

Process::~Process() {
  if (reaper_ > 0) end(false);
}

std::string Process::take_messages() {
  messages_.read();
  messages_.cut();
  return std::exchange(messages_.text, {});
}

ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits) {
  Process process(command, limits.memory_bytes, kOutputBytes);
  process.close_input();
  const auto allowed =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  const auto stop =
      process.exchange({}, Clock::now() + allowed, [](const std::string&) { return false; });
  return process.end(stop == Process::Stop::kTimeout);
}

std::string last_words(std::string_view messages) {
  const size_t end = messages.find_last_not_of(" \r\n");
  if (end == std::string_view::npos) return {};
  const size_t line_break = messages.find_last_of('\n', end);
  const size_t begin = line_break == std::string_view::npos ? 0 : line_break + 1;
  return ": " + std::string(messages.substr(begin, end + 1 - begin));
}

}  // namespace hmlfc::conform
