// Decoded views and stages of a decoder under test beside those of the golden model.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "conform/judge.hpp"
#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// Asks the decoder under test for the stages of a block: text with a JSON object a line
/// (stage_trace.hpp), or why there is none. Empty where it gives no traces.
using Tracer = std::function<DutAnswer<std::string>(const BlockAddress&, int stop_level)>;

/// The first wrong stage of a block (first_wrong_stage), or why none is known: there is no trace,
/// all its stages agree. Empty without a tracer.
std::string wrong_stage(const Decoder& golden, const BlockAddress& block, int stop_level,
                        const Tracer& tracer);

/// The golden model of a trial's stream. CRCs of sections are not checked: the decoder may have
/// left them unchecked (FIL-6). Sets an error in `result` if it cannot open the stream.
Result<Decoder> golden_decoder(const Trial& trial, VectorResult& result);

/// Compares views, and sets difference, reason, stage and pictures where they differ.
void describe_difference(const Trial& trial, const Decoder& golden,
                         const std::vector<RgbImage>& expected, const std::vector<RgbImage>& actual,
                         const Tracer& tracer, VectorResult& result);

/// Judges all views of a stream that must decode, by `output` (null: by the golden model alone).
void judge_views(const Trial& trial, const Decoder& golden, const std::vector<RgbImage>& actual,
                 const vectors::ViewSum* output, const Tracer& tracer, VectorResult& result);

}  // namespace hmlfc::conform
