// Options of the commands that run decoders under test.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "conform/dut.hpp"
#include "conform/process.hpp"

namespace hmlfc::cli {

/// --dut, --timeout and --memory.
struct DutOptions {
  std::vector<std::string> names;
  uint32_t timeout_seconds = 60;
  uint32_t memory_mib = 8192;

  /// Adds the options; with `several`, --dut may be repeated.
  void add_to(CLI::App& app, bool several);

  conform::ProcessLimits limits() const;

  /// The decoders of --dut. Failures: none given, or not readable (kUsage).
  std::vector<conform::Dut> read() const;
};

}  // namespace hmlfc::cli
