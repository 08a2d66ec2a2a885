// Runs a program within limits.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files.hpp"

namespace hmlfc::conform {

struct ProcessLimits {
  double seconds = 60;        ///< wall-clock time, > 0
  uint64_t memory_bytes = 0;  ///< of address space; 0: no limit
};

enum class ProcessEnd : uint8_t {
  kExit,        ///< `value` is its exit status
  kSignal,      ///< `value` is the signal that ended it
  kTimeout,     ///< it ran out of time
  kNotStarted,  ///< `value` is the errno
};

/// How a program ended, and its output.
struct ProcessOutcome {
  ProcessEnd end = ProcessEnd::kNotStarted;
  int value = 0;
  double seconds = 0;
  std::string output;    ///< standard output, its last 16 MiB
  std::string messages;  ///< standard error, its last 8 KiB
  std::string program;   ///< of its command
};

/// A program below a reaper (reaper.hpp), with a pipe to each of its standard streams. At its end,
/// and at that of this process, all processes that it has started are killed, also those in a
/// session of their own. SIGPIPE must be ignored.
class Process {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Suffices = std::function<bool(const std::string& output)>;

  /// Why exchange() ended.
  enum class Stop : uint8_t { kSuffices, kEnded, kTimeout };

  /// Starts `command` (program and arguments; PATH is searched) in `memory_bytes` of address space,
  /// 0: no limit. Keeps the last `output_bytes` of its standard output. Throws std::system_error.
  Process(const std::vector<std::string>& command, uint64_t memory_bytes, size_t output_bytes);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// Writes `text` to its standard input, and reads what it writes until `suffices`, its end, or
  /// the deadline.
  Stop exchange(std::string_view text, Time deadline, const Suffices& suffices);

  /// Ends its standard input.
  void close_input() { input_ = {}; }

  /// Its standard output that is not yet taken; the caller erases what it has used.
  std::string& output() { return output_.text; }

  /// The last 8 KiB of its standard error since the last call.
  std::string take_messages();

  /// Kills it, and says how it ended: by itself, or with `timed_out` for lack of time. Output and
  /// messages are those not yet taken.
  ProcessOutcome end(bool timed_out);

 private:
  // The end of what a pipe gives.
  struct Tail {
    io::FileDescriptor pipe;
    size_t keep;
    bool open = true;
    std::string text{};

    void read();
    void cut();
  };

  // A reaper ends within 10 s; one that does not is killed, and leaves what it has not killed.
  void wait_for_reaper();

  std::string program_;
  Time begin_;
  io::FileDescriptor input_;
  io::FileDescriptor control_;  // closed, it ends the program
  io::FileDescriptor report_;   // gives a ReaperReport
  Tail output_;
  Tail messages_;
  pid_t reaper_ = -1;
  io::FileDescriptor handle_;  // of the reaper, which ends after the program
};

/// Runs `command` in `limits` with an empty standard input until it ends. Thread-safe.
ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits);

/// "exit status 3", "signal 11 (Segmentation fault)", "timed out after 60.0 s", "mydec
/// cannot be started: No such file or directory".
std::string to_string(const ProcessOutcome& outcome);

/// ": " and the last line of a program's messages; empty if there is none.
std::string last_words(std::string_view messages);

}  // namespace hmlfc::conform
