// A suite of vectors on disk, and a decoder run on it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "conform/dut.hpp"
#include "conform/process.hpp"
#include "conform/result.hpp"
#include "io/parallel.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::conform {

/// A manifest and where its files are.
struct Suite {
  std::filesystem::path folder;
  vectors::Manifest manifest;
  std::string manifest_sha256;  ///< of manifest.json, tells suites apart
};

/// Errors: those of vectors::read_manifest().
io::IoResult<Suite> open_suite(const std::filesystem::path& folder);

/// Which vectors to run, of those that a decoder claims. Shard I of N has the vectors of the
/// manifest whose number is I - 1 modulo N.
struct Selection {
  std::vector<std::string> filters;  ///< any of them must match; none: all do
  unsigned shard = 1;                ///< [1, shards]
  unsigned shards = 1;
};

struct RunOptions {
  std::filesystem::path folder;  ///< of the report; a folder for the decoder is made in it
  Selection selection;
  ProcessLimits limits;
  unsigned jobs = 1;    ///< vectors at the same time
  bool resume = false;  ///< results that an earlier run left in the folder are taken over
  bool keep = false;    ///< what the decoder wrote for vectors that fail stays
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
