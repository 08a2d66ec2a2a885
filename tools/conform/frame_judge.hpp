// Judges a renderer by one frame or map of the suite.
#pragma once

#include "conform/judge.hpp"
#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// Opens the stream of `trial`, asks `dut` for the record of the trial's camera, if it makes
/// records, and for the frame or the map, and compares. Of a wrong frame the difference says where
/// (its "blocks" are pixels) and, if the renderer traces pixels, the stage what first went wrong.
/// Counts and the place of an error are compared as far as the renderer tells them. One that cannot
/// be asked has the status not_supported. Sets what judge() says. Throws DutFailure.
void judge_frame(const Trial& trial, RunningDut& dut, VectorResult& result);

}  // namespace hmlfc::conform
