#include "conform/reaper.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

// Without C linkage of its own in glibc 2.36.
extern "C" {
#include <sys/pidfd.h>
}

namespace hmlfc::conform {
namespace {

constexpr rlim_t kFileBytes = rlim_t{4} << 30;  // of each file that the program writes
constexpr int kCannotExec = 127;
constexpr int kRounds = 5000;  // of a millisecond, for processes that do not die of SIGKILL

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(resource, &both);
}

void report(const ReaperPipes& pipes, bool started, int value) {
  const ReaperReport text{started, value};
  [[maybe_unused]] const ssize_t written = ::write(pipes.report, &text, sizeof text);
}

// Closes every descriptor but `pipes`, which move to others. Those of other programs would keep
// their pipes open.
bool take_only(ReaperPipes& pipes) {
  int* const ends[] = {&pipes.input, &pipes.output, &pipes.messages, &pipes.control, &pipes.report};
  int first = 0;
  for (const int* end : ends) first = std::max(first, *end + 1);
  int next = first;
  for (int* end : ends) {
    if (::dup3(*end, next, O_CLOEXEC) < 0) return false;
    *end = next++;
  }
  ::close_range(0, static_cast<unsigned>(first - 1), 0);
  ::close_range(static_cast<unsigned>(next), ~0u, 0);
  return true;
}

[[noreturn]] void become(char* const* arguments, uint64_t memory_bytes, const ReaperPipes& pipes) {
  ::setpgid(0, 0);
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kFileBytes);
  if (memory_bytes != 0) limit(RLIMIT_AS, memory_bytes);
  ::dup2(pipes.input, STDIN_FILENO);
  ::dup2(pipes.output, STDOUT_FILENO);
  ::dup2(pipes.messages, STDERR_FILENO);
  ::execvp(arguments[0], arguments);
  report(pipes, false, errno);
  ::_exit(kCannotExec);
}

// Kills the children of this process. Theirs become its own then.
void kill_children() {
  const int file = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  std::array<char, 4096> text;
  pid_t child = 0;
  for (ssize_t count = 0; (count = ::read(file, text.data(), text.size())) > 0;) {
    for (ssize_t i = 0; i < count; ++i) {
      const char c = text[static_cast<size_t>(i)];
      if (c >= '0' && c <= '9') {
        child = child * 10 + (c - '0');
      } else {
        if (child > 0) ::kill(child, SIGKILL);
        child = 0;
      }
    }
  }
  ::close(file);
}

}  // namespace

void reap(char* const* arguments, uint64_t memory_bytes, const ReaperPipes& inherited) {
  ReaperPipes pipes = inherited;
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t program = take_only(pipes) ? ::_Fork() : -1;
  if (program == 0) become(arguments, memory_bytes, pipes);
  if (program < 0) {
    report(pipes, false, errno);
    ::_exit(kCannotExec);
  }
  ::setpgid(program, program);  // parent and child both do it: either may run first
  for (const int end : {pipes.input, pipes.output, pipes.messages}) ::close(end);
  std::array<pollfd, 2> ends{pollfd{::pidfd_open(program, 0), POLLIN, 0},
                             pollfd{pipes.control, POLLIN, 0}};
  while (::poll(ends.data(), ends.size(), -1) < 0 && errno == EINTR) {
  }
  ::kill(-program, SIGKILL);  // not yet waited for: the number is still its own
  for (int round = 0; round < kRounds; ++round) {
    kill_children();
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended == program) report(pipes, true, status);
    }
    if (ended < 0) break;
    ::poll(nullptr, 0, 1);
  }
  ::_exit(0);
}

}  // namespace hmlfc::conform
