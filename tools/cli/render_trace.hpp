// hmlfc render --trace, and the same for the page: how one pixel of a frame comes about.
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

#include "cli/camera_options.hpp"
#include "cli/output.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// Adds --trace X,Y.
CLI::Option* add_trace(CLI::App& app, std::optional<FramePixel>& pixel);

/// Every number of frame_trace() for `pixel` of the frame of `record` with `stop_level`, under the
/// keys that `hmlfc render --help` lists. Failures: the frame has no such pixel (kUsage); a corrupt
/// stream (kCorrupt).
Json trace_json(const StreamFile& file, const FrameRecord& record, int stop_level,
                FramePixel pixel);

/// Prints trace_json() where `json`, else the same as text with a line for the numbers of a clause.
/// Failures: those of trace_json().
void print_trace(const StreamFile& file, const FrameRecord& record, int stop_level,
                 FramePixel pixel, bool json);

}  // namespace hmlfc::cli
