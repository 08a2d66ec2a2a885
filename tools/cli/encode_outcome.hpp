// What hmlfc encode is asked for, and what it tells.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/measure.hpp>

#include "cli/arguments.hpp"
#include "cli/coding_options.hpp"
#include "cli/comparison.hpp"
#include "cli/rig_options.hpp"
#include "cli/stream_report.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

inline constexpr uint32_t kMostShards = 1u << 24;

/// Shard `index` of `count`: count in [1, kMostShards], index in [1, count].
struct ShardNumber {
  uint32_t index = 1;
  uint32_t count = 1;
};

/// The values of the options.
struct EncodeOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path target;  ///< where it is written: output, or a file for standard output
  bool force = false;
  io::ViewNaming naming;
  std::optional<io::ViewPart> part;
  CodingOptions coding;
  RigOptions rig;
  std::optional<uint64_t> memory;  ///< bytes
  bool plan = false;
  std::optional<ShardNumber> shard;
  std::vector<std::filesystem::path> shards;  ///< to assemble
  bool json = false;
  const CLI::App* app = nullptr;  ///< tells which options were given
};

/// The result of encoding, and its cost.
struct EncodeOutcome {
  io::StreamReport stream;
  Quality quality;
  EncodeParams params;
  std::string rig;  ///< rig_line()
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< of all threads of the process
  std::optional<EncodeForecast> forecast = {};
};

/// Whether all views are in one file: a quilt or a video.
bool is_one_file(const EncodeOptions& options);

/// The views that `options` name. Failures (kInput): those of views_in() and io::part_of; (kUsage):
/// they are in one file.
io::ViewList listed_views(const EncodeOptions& options);

/// The failure to encode `input`: kInput, or kOutOfMemory.
Failure encode_failure(const std::filesystem::path& input, const EncodeError& error);

/// Fails unless the stream decodes to the encoder's own reconstruction.
void check_promise(const ErrorSums& promised, const ErrorSums& measured, const std::string& file);

/// Prints `outcome`; says if a target of `options` was not met, and how far the encoding got.
ExitCode tell_outcome(const EncodeOptions& options, const EncodeOutcome& outcome);

}  // namespace hmlfc::cli
