// Runs a decoder on a stream and judges what it does by the manifest and the golden model.
#pragma once

#include <filesystem>
#include <span>

#include "conform/dut.hpp"
#include "conform/process.hpp"
#include "conform/result.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::conform {

/// One run of a decoder on one stream.
struct Trial {
  const Dut& dut;
  std::filesystem::path input;      ///< where each run gets a copy of the stream
  std::span<const uint8_t> stream;  ///< its bytes
  std::filesystem::path output;     ///< the folder that a command line is told to write into
  ProcessLimits limits;
  vectors::Expectation expect;                ///< what must come of it
  const vectors::ViewSum* views;              ///< of a stream that must decode; null: not known
  std::filesystem::path pictures{};           ///< folder for the pictures of a failure; empty: none
  std::filesystem::path blocks{};             ///< the vector's blocks file; empty: none
  const vectors::FrameCase* frame = nullptr;  ///< asked for instead of views; null: none
};

/// Why right samples are no pass.
inline constexpr const char* kOtherSuite =
    "equal to the golden model, which differs from the manifest: the suite is of another version "
    "or damaged";

/// Runs the decoder and compares what it does with `trial.expect`, its views with `trial.views` or
/// else with the golden model's. A decoder that answers for blocks is asked for some: of a stream
/// in which blocks fail for every block and, of up to 256 blocks, for every stop level above 0; of
/// other streams for 16 blocks at each stop level. A vector that fails in a process that had
/// streams before is run again in a new one, and the reason says if it passes there. Sets status,
/// reason, kind, difference, stage, messages, seconds and pictures.
void judge(const Trial& trial, VectorResult& result);

}  // namespace hmlfc::conform
