// The process between the runner and a program: it starts the program, and ends all that comes of
// it.
#pragma once

#include <cstdint>

namespace hmlfc::conform {

/// Ends of pipes, inherited by the reaper.
struct ReaperPipes {
  int input;     ///< to read: the program's standard input
  int output;    ///< to write: its standard output
  int messages;  ///< to write: its standard error
  int control;   ///< to read: once nobody can write there, everything is to end
  int report;    ///< to write: one ReaperReport or two
};

/// What became of the program. Where it could not be started, that is reported first.
struct ReaperReport {
  bool started;
  int value;  ///< its status as waitpid() has it, or the errno of fork or exec
};

/// Runs in a new process, a copy of one with threads, so it calls only async-signal-safe functions.
/// Starts `arguments` (null after the last; PATH is searched) in a process group of its own, in
/// `memory_bytes` of address space (0: no limit). Waits until that ends or `control` says so, then
/// kills what is left of its descendants, in whatever session, reports, and exits. Also the end of
/// the process that holds the other end of `control` ends everything.
[[noreturn]] void reap(char* const* arguments, uint64_t memory_bytes, const ReaperPipes& pipes);

}  // namespace hmlfc::conform
