// Judges a decoder's outcome on a vector by the manifest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

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
  std::filesystem::path input;      ///< the stream's file
  std::span<const uint8_t> stream;  ///< its bytes
  std::filesystem::path output;     ///< the folder that the decoder was told to write into
  ProcessLimits limits;             ///< for another run with a trace
  std::filesystem::path pictures;   ///< folder for the pictures of a failure; empty: none
};

/// Compares the outcome of a trial with `expect` and, where the stream must decode, its views with
/// `output` (null: with the golden model's views alone). Sets status, reason, difference, stage and
/// pictures.
void judge(const Trial& trial, const ProcessOutcome& outcome, const vectors::Expectation& expect,
           const vectors::ViewSum* output, VectorResult& result);

}  // namespace hmlfc::conform
