// The other end of the line protocol: answers requests by the functions of hmlfc_dut.h.
#pragma once

#include <cstdint>

#include "conform/dut_library.hpp"

namespace hmlfc::conform {

/// Why serve_lines() returned.
enum class ServeEnd : uint8_t {
  kInput,      ///< standard input ended
  kOutput,     ///< standard output cannot be written
  kCannotRun,  ///< the decoder cannot run on this machine; a request is left without its answer
  kNoFile,     ///< a stream's file cannot be read; a message says so
};

/// Answers the requests of standard input on standard output (docs/line_protocol.md). What
/// `functions` print on standard output goes to standard error.
ServeEnd serve_lines(const DutFunctions& functions);

}  // namespace hmlfc::conform
