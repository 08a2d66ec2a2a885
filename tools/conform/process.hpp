// One program run to its end, within limits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hmlfc::conform {

/// Limits of a program.
struct ProcessLimits {
  double seconds = 60;        ///< wall-clock time, > 0
  uint64_t memory_bytes = 0;  ///< of address space; 0: no limit
};

enum class ProcessEnd : uint8_t {
  kExit,        ///< `value` is its exit status
  kSignal,      ///< `value` is the signal that ended it
  kTimeout,     ///< its time was over
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

/// Runs `command` (program and arguments; the program is searched in PATH) in a process group of
/// its own, with an empty standard input, and waits for it. When it ends or its time is over, the
/// whole group is killed, so that nothing it started survives.
///
/// May be called from several threads at the same time.
ProcessOutcome run_process(const std::vector<std::string>& command, const ProcessLimits& limits);

/// "exit status 3", "signal 11 (Segmentation fault)", "no end within its time", "cannot be started:
/// No such file or directory".
std::string to_string(const ProcessOutcome& outcome);

}  // namespace hmlfc::conform
