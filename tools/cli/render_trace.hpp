// hmlfc render --trace: how one pixel of a frame comes about.
#pragma once

#include "cli/camera_options.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// Prints every number of frame_trace() for `pixel` of the frame of `record` with `stop_level`, a
/// line for those of a clause; as JSON the keys that `hmlfc render --help` lists. Failures: the
/// frame has no such pixel (kUsage); a corrupt stream (kCorrupt).
void print_trace(const StreamFile& file, const FrameRecord& record, int stop_level,
                 FramePixel pixel, bool json);

}  // namespace hmlfc::cli
