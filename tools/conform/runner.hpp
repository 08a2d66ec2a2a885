// Runs a decoder on a suite of vectors on disk.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
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
  vectors::Manifest manifest;   ///< with `frames`, frames_of() it
  bool frames = false;          ///< for renderers
  std::string manifest_sha256;  ///< of manifest.json; identifies the suite
};

/// Errors: those of vectors::read_manifest().
io::IoResult<Suite> open_suite(const std::filesystem::path& folder, bool frames);

/// Which vectors to run, of those that a decoder claims; their bases are run, too. Shard I of N has
/// the vectors of the manifest whose number is I - 1 modulo N.
struct Selection {
  std::vector<std::string> filters;  ///< any of them must match (vectors::matches); none: all do
  std::string milestone;             ///< only its vectors; empty: all
  unsigned shard = 1;                ///< [1, shards]
  unsigned shards = 1;
};

struct RunOptions {
  std::filesystem::path folder;  ///< of the report; gets a folder for the decoder
  Selection selection;
  ProcessLimits limits;
  unsigned jobs = 1;    ///< vectors at the same time
  bool resume = false;  ///< keep the results of an earlier run in the folder
};

/// Runs `dut` on each vector of `suite` that it claims and `options` select, and compares. Each
/// result is written at once (results.jsonl). A refusal counts only if the vector's base passes.
/// Errors: the folder cannot be written, or has results of another suite or decoder.
io::IoResult<Run> run_suite(const Suite& suite, const Dut& dut, const RunOptions& options,
                            const io::Progress& progress);

/// Runs `dut` on one stream, in a new folder `work`-XXXXXX, and compares it with the golden model:
/// it must decode what the model decodes, and reject what it rejects. With `frame` it is asked for
/// the frame of its camera and stop level instead of the views.
VectorResult run_stream(const Dut& dut, std::span<const uint8_t> stream,
                        const std::filesystem::path& work, const ProcessLimits& limits,
                        const std::optional<vectors::FrameCase>& frame = std::nullopt);

}  // namespace hmlfc::conform
