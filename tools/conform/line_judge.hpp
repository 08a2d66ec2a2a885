// Judges a decoder that speaks the line protocol: views, single blocks with their errors, stop
// levels.
#pragma once

#include "conform/judge.hpp"

namespace hmlfc::conform {

/// As judge(), for a decoder with `lines`. Asks for every view. Of a stream in which blocks fail it
/// asks for every block and, of up to 256 blocks, for every stop level above 0; of other streams
/// for 16 blocks at each stop level. A vector that fails in a process that had streams before is
/// run again in a new one, and the reason says if it passes there.
void judge_lines(const Trial& trial, const vectors::Expectation& expect,
                 const vectors::ViewSum* output, VectorResult& result);

}  // namespace hmlfc::conform
