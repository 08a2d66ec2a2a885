// Runs a decoder on a vector and judges what it does by the manifest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <hmlfc/decoder.hpp>

#include "conform/dut.hpp"
#include "conform/process.hpp"
#include "conform/result.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::conform {

/// The exit status of a decoder that cannot run here (no device, no licence): the vector is
/// skipped, which is not a pass.
inline constexpr int kExitSkipped = 77;

/// One run of a decoder on one stream.
struct Trial {
  const Dut& dut;
  std::filesystem::path input;      ///< where each run gets a copy of the stream
  std::span<const uint8_t> stream;  ///< its bytes
  std::filesystem::path output;     ///< the folder that the decoder was told to write into
  ProcessLimits limits;
  std::filesystem::path pictures;  ///< folder for the pictures of a failure; empty: none
  std::filesystem::path blocks;    ///< the vector's blocks file; empty: none
};

/// Writes the stream to `trial.input`, where a run before may have left anything. Errors: cannot
/// write.
io::IoResult<void> hand_over(const Trial& trial);

/// What the decoder's command `trace`, which it has, prints of a block (stage_trace.hpp), or why it
/// prints nothing.
tl::expected<std::string, std::string> trace_by_command(const Dut& dut,
                                                        const std::filesystem::path& input,
                                                        const BlockAddress& block,
                                                        const ProcessLimits& limits);

/// Runs the decoder and compares what it does with `expect` and, where the stream must decode, its
/// views with `output` (null: with the golden model's views alone). A decoder that speaks the line
/// protocol is judged by block, too. Sets status, reason, difference, stage, messages, seconds and
/// pictures.
void judge(const Trial& trial, const vectors::Expectation& expect, const vectors::ViewSum* output,
           VectorResult& result);

}  // namespace hmlfc::conform
