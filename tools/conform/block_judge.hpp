// Compares single blocks of a decoder under test, their samples and errors, with the golden model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <hmlfc/decoder.hpp>

#include "conform/running_dut.hpp"
#include "conform/view_judge.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::conform {

/// "bad_mode", or "samples" where there is no error.
template <class T>
std::string outcome_name(const DutAnswer<T>& answer) {
  return answer ? "samples" : answer.error();
}

template <class T>
std::string outcome_name(const Result<T>& golden) {
  return golden ? "samples" : std::string(error_name(golden.error().code));
}

/// How many blocks are asked for, spread evenly over the stream.
struct BlockCounts {
  uint64_t at_level_0 = 0;
  uint64_t at_each_above = 0;  ///< stop level, if the decoder has them
};
inline constexpr uint64_t kAllBlocks = UINT64_MAX;

/// Compares blocks; where one is wrong, `result` fails with the first, its kind and its stage.
/// Throws DutFailure.
void judge_blocks(const Decoder& golden, RunningDut& dut, const Tracer& tracer, BlockCounts counts,
                  VectorResult& result);

/// Whether the golden model has the errors that the manifest states by hand, and the checksums of
/// all other blocks in the file `blocks` (empty: not compared).
bool suite_agrees(const Decoder& golden, const vectors::Expectation& expect,
                  const std::filesystem::path& blocks);

}  // namespace hmlfc::conform
