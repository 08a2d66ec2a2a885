#include "conform/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "conform/reaper.hpp"

// Without C linkage of its own in glibc 2.36.
extern "C" {
#include <sys/pidfd.h>
}

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;
using io::FileDescriptor;

constexpr size_t kMessageBytes = 8192;
constexpr int kReaperRounds = 100;   // of 0.1 s: a reaper takes half of them at most
constexpr int kBuffersAtATime = 16;  // so that no program keeps the reader from its deadline

struct Pipe {
  FileDescriptor read;
  FileDescriptor write;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<int64_t>(left, 0, 1000));
}

// Writes what the pipe takes of `text` and removes it; closes a pipe that nobody reads.
void write_some(FileDescriptor& pipe, std::string_view& text) {
  const ssize_t count = ::write(pipe.get(), text.data(), text.size());
  if (count > 0) text.remove_prefix(static_cast<size_t>(count));
  if (count < 0 && errno != EAGAIN && errno != EINTR) {
    pipe = {};
    text = {};
  }
}

}  // namespace

void Process::Tail::read() {
  std::array<char, 65536> buffer;
  for (int i = 0; open && i < kBuffersAtATime; ++i) {
    const ssize_t count = ::read(pipe.get(), buffer.data(), buffer.size());
    if (count < 0) return;
    if (count == 0) open = false;
    text.append(buffer.data(), static_cast<size_t>(count));
    if (text.size() / 2 > keep) cut();
  }
}

Process::Process(const std::vector<std::string>& command, uint64_t memory_bytes,
                 size_t output_bytes)
    : program_(command.front()),
      begin_(Clock::now()),
      output_{{}, output_bytes},
      messages_{{}, kMessageBytes} {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Pipe input = make_pipe();
  Pipe output = make_pipe();
  Pipe messages = make_pipe();
  Pipe control = make_pipe();
  Pipe report = make_pipe();
  reaper_ = ::fork();
  if (reaper_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (reaper_ == 0) {
    reap(arguments.data(), memory_bytes,
         {input.read.get(), output.write.get(), messages.write.get(), control.read.get(),
          report.write.get()});
  }
  for (const FileDescriptor* end : {&input.write, &output.read, &messages.read, &report.read}) {
    ::fcntl(end->get(), F_SETFL, O_NONBLOCK);
  }
  input_ = std::move(input.write);
  control_ = std::move(control.write);
  report_ = std::move(report.read);
  output_.pipe = std::move(output.read);
  messages_.pipe = std::move(messages.read);
  handle_ = FileDescriptor(::pidfd_open(reaper_, 0));
}

Process::Stop Process::exchange(std::string_view text, Time deadline, const Suffices& suffices) {
  const auto entry = [](const Tail& tail) {
    return pollfd{tail.open ? tail.pipe.get() : -1, POLLIN, 0};
  };
  for (;;) {
    if (text.empty() && suffices(output_.text)) return Stop::kSuffices;
    std::array<pollfd, 4> entries{entry(output_), entry(messages_),
                                  pollfd{handle_.get(), POLLIN, 0},
                                  pollfd{text.empty() ? -1 : input_.get(), POLLOUT, 0}};
    ::poll(entries.data(), entries.size(), milliseconds_until(deadline));
    if (entries[3].revents != 0) write_some(input_, text);
    output_.read();
    messages_.read();
    if ((entries[2].revents & POLLIN) != 0) {
      return suffices(output_.text) ? Stop::kSuffices : Stop::kEnded;
    }
    if (Clock::now() >= deadline) return Stop::kTimeout;
  }
}

void Process::wait_for_reaper() {
  pollfd ended{handle_.get(), POLLIN, 0};
  for (int round = 0; round < kReaperRounds && ended.revents == 0; ++round) {
    ::kill(reaper_, SIGCONT);  // a program may have stopped it
    ::poll(&ended, 1, 100);
  }
  ::kill(reaper_, SIGKILL);
  while (::waitpid(reaper_, nullptr, 0) < 0 && errno == EINTR) {
  }
  reaper_ = -1;
}

ProcessOutcome Process::end(bool timed_out) {
  control_ = {};
  wait_for_reaper();
  output_.read();
  output_.cut();
  ProcessOutcome outcome;
  outcome.program = program_;
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  outcome.output = std::move(output_.text);
  outcome.messages = take_messages();
  ReaperReport report{true, SIGKILL};  // of a program that has killed its reaper
  const bool told = ::read(report_.get(), &report, sizeof report) == sizeof report;
  if (!report.started) {
    outcome.end = ProcessEnd::kNotStarted;
    outcome.value = report.value;
  } else if (timed_out || !told) {
    outcome.end = timed_out ? ProcessEnd::kTimeout : ProcessEnd::kSignal;
    outcome.value = SIGKILL;
  } else if (WIFSIGNALED(report.value)) {
    outcome.end = ProcessEnd::kSignal;
    outcome.value = WTERMSIG(report.value);
  } else {
    outcome.end = ProcessEnd::kExit;
    outcome.value = WEXITSTATUS(report.value);
  }
  return outcome;
}

std::string to_string(const ProcessOutcome& outcome) {
  switch (outcome.end) {
    case ProcessEnd::kExit:
      return fmt::format("exit status {}", outcome.value);
    case ProcessEnd::kSignal:
      return fmt::format("signal {} ({})", outcome.value, ::strsignal(outcome.value));
    case ProcessEnd::kTimeout:
      return fmt::format("timed out after {:.1f} s", outcome.seconds);
    case ProcessEnd::kNotStarted:
      return fmt::format("{} cannot be started: {}", outcome.program,
                         std::generic_category().message(outcome.value));
  }
  return {};
}

}  // namespace hmlfc::conform
