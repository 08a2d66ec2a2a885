// What `encode` and `info` say about a stream.
#pragma once

#include <string>

#include <hmlfc/format.hpp>

#include "cli/view_source.hpp"
#include "io/stream_report.hpp"

namespace hmlfc::cli {

/// Reads every tile of `file`. Failure (kCorrupt) as for decoding.
io::StreamReport report_on(const StreamFile& file);

/// "hmlfc, profile main, 4x4 blocks, window 16, clusters of 2x2, 4:2:0".
std::string describe_coding(const StreamHeader& header);

/// "Size          123 456 bytes, 0.0345 bpp, 695.7 times smaller" and where the bytes go.
std::string size_text(const io::StreamReport& report);

}  // namespace hmlfc::cli
