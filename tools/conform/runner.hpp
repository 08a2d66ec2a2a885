// Runs a decoder on a suite.
#pragma once

#include <filesystem>
#include <functional>

#include "conform/dut.hpp"
#include "conform/process.hpp"
#include "conform/result.hpp"
#include "conform/suite.hpp"
#include "io/parallel.hpp"

namespace hmlfc::conform {

struct RunOptions {
  std::filesystem::path folder;  ///< of the report; a folder for the decoder is made in it
  Selection selection;
  ProcessLimits limits;
  unsigned jobs = 1;     ///< vectors at the same time
  bool resume = false;   ///< results that an earlier run left in the folder are taken over
  bool keep = false;     ///< what the decoder wrote for vectors that fail stays
  bool pictures = true;  ///< of failures
};

/// Runs `dut` on each vector of `suite` that it claims and `options` select, and compares. Each
/// result is written to the folder as soon as it is there (results.jsonl). Errors: the folder
/// cannot be written, or has results of another suite or decoder.
io::IoResult<Run> run_suite(const Suite& suite, const Dut& dut, const RunOptions& options,
                            const io::Progress& progress);

/// The name of the folder of decoder `dut` in a report: letters, digits, - and _ of its name.
std::string folder_name(const std::string& dut);

/// Runs `dut` on one stream, in the folder `work`, which is made for it and removed, and judges it
/// against the golden model: it must decode what the model decodes, and refuse what it refuses.
VectorResult run_stream(const Dut& dut, std::span<const uint8_t> stream,
                        const std::filesystem::path& work, const ProcessLimits& limits);

}  // namespace hmlfc::conform
