#include "conform/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "io/files.hpp"

// Without C linkage of its own in glibc 2.36.
extern "C" {
#include <sys/pidfd.h>
}

namespace hmlfc::conform {
namespace {

using Clock = std::chrono::steady_clock;
using io::FileDescriptor;

constexpr size_t kOutputBytes = size_t{16} << 20;
constexpr size_t kMessageBytes = 8192;
constexpr rlim_t kFileBytes = rlim_t{4} << 30;  // of each file that the program writes
constexpr int kCannotExec = 127;

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

// The last `keep` bytes read from a pipe.
class Tail {
 public:
  Tail(const FileDescriptor& pipe, size_t keep) : pipe_(pipe), keep_(keep) {
    ::fcntl(pipe_.get(), F_SETFL, O_NONBLOCK);
  }

  // Reads what is available; false once the other end is closed.
  bool read() {
    std::array<char, 65536> buffer;
    while (open_) {
      const ssize_t count = ::read(pipe_.get(), buffer.data(), buffer.size());
      if (count < 0) return errno == EAGAIN || errno == EINTR;
      if (count == 0) open_ = false;
      text_.append(buffer.data(), static_cast<size_t>(count));
      if (text_.size() > 2 * keep_) text_.erase(0, text_.size() - keep_);
    }
    return false;
  }

  pollfd poll_entry() const { return {open_ ? pipe_.get() : -1, POLLIN, 0}; }

  std::string take() {
    if (text_.size() > keep_) text_.erase(0, text_.size() - keep_);
    return std::move(text_);
  }

 private:
  const FileDescriptor& pipe_;
  size_t keep_;
  bool open_ = true;
  std::string text_;
};

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(resource, &both);
}

// Runs in the child, so it calls only async-signal-safe functions. Writes the errno of a failed
// exec to `failure`.
[[noreturn]] void become(char* const* arguments, const ProcessLimits& limits, int output,
                         int messages, int failure) {
  ::setpgid(0, 0);
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kFileBytes);
  if (limits.memory_bytes != 0) limit(RLIMIT_AS, limits.memory_bytes);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  ::execvp(arguments[0], arguments);
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = ::write(failure, &reason, sizeof reason);
  ::_exit(kCannotExec);
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<int64_t>(left, 0, 1000));
}

// Reads until the child ends; false if the deadline comes first.
bool wait_for_end(pid_t child, Tail& output, Tail& messages, Clock::time_point deadline) {
  const FileDescriptor process(::pidfd_open(child, 0));
  for (;;) {
    std::array<pollfd, 3> entries{output.poll_entry(), messages.poll_entry(),
                                  pollfd{process.get(), POLLIN, 0}};
    ::poll(entries.data(), entries.size(), milliseconds_until(deadline));
    output.read();
    messages.read();
    if ((entries[2].revents & POLLIN) != 0) return true;
    if (Clock::now() >= deadline) return false;
  }
}

}  // namespace

ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Pipe output = make_pipe();
  Pipe messages = make_pipe();
  Pipe failure = make_pipe();
  const auto begin = Clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    become(arguments.data(), limits, output.write.get(), messages.write.get(), failure.write.get());
  }
  ::setpgid(child, child);  // parent and child both do it: either may run first
  output.write = {};
  messages.write = {};
  failure.write = {};
  Tail output_tail(output.read, kOutputBytes);
  Tail message_tail(messages.read, kMessageBytes);
  const auto allowed =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  const bool ended = wait_for_end(child, output_tail, message_tail, begin + allowed);
  ::kill(-child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  output_tail.read();
  message_tail.read();

  ProcessOutcome outcome;
  outcome.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  outcome.output = output_tail.take();
  outcome.messages = message_tail.take();
  int reason = 0;
  if (::read(failure.read.get(), &reason, sizeof reason) == sizeof reason) {
    outcome.end = ProcessEnd::kNotStarted;
    outcome.value = reason;
  } else if (!ended) {
    outcome.end = ProcessEnd::kTimeout;
  } else if (WIFSIGNALED(status)) {
    outcome.end = ProcessEnd::kSignal;
    outcome.value = WTERMSIG(status);
  } else {
    outcome.end = ProcessEnd::kExit;
    outcome.value = WEXITSTATUS(status);
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
      return fmt::format("cannot be started: {}", std::generic_category().message(outcome.value));
  }
  return {};
}

}  // namespace hmlfc::conform
