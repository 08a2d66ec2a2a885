// Runs a program within limits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
};

/// Runs `command` (program and arguments; PATH is searched) in a process group of its own, with an
/// empty standard input, and waits for it. When it ends or runs out of time, the whole group is
/// killed, so that nothing it started survives. Thread-safe.
ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits);

/// "exit status 3", "signal 11 (Segmentation fault)", "timed out after 60.0 s", "cannot be started:
/// No such file or directory".
std::string to_string(const ProcessOutcome& outcome);

}  // namespace hmlfc::conform
