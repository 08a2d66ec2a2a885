// What `encode` and `info` say about a stream.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>
#include <hmlfc/statistics.hpp>

#include "cli/output.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// Size, header and contents of one stream.
struct StreamReport {
  uint64_t bytes = 0;
  StreamHeader header;
  StreamStatistics statistics;

  /// Bits of the whole file per pixel of all views.
  double bits_per_pixel() const;

  /// Bits of the pixels, 3 * depth each, per bit of the file.
  double ratio() const;
};

/// Reads every tile of `file`. Failure (kCorrupt) as for decoding.
StreamReport report_on(const StreamFile& file);

/// The keys that encode and info share: bytes, bpp, ratio, rows, cols, width, height, profile,
/// method, sections.
Json report_json(const StreamReport& report);

/// The parameters in the header, for info: depth, chroma, block, window, cluster, tree_height,
/// tools, levels and the states of the blocks.
void add_structure(const StreamReport& report, Json& json);

/// Images of a level of which levels_json() looks for key images at most.
inline constexpr uint64_t kMostListedImages = 4096;

/// The levels of the tree from the top: level, rows, cols, ref_rows, ref_cols, key_images (their
/// number) and keys, their rows and columns: empty where the level has over kMostListedImages
/// images.
Json levels_json(const StreamHeader& header);

/// Names of the feature flags that are set.
std::vector<std::string> tools_of(const StreamHeader& header);

/// "hmlfc, profile main, 4x4 blocks, window 16, clusters of 2x2, 4:2:0".
std::string describe_coding(const StreamHeader& header);

/// "Size          123 456 bytes, 0.0345 bpp, 695.7 times smaller" and where the bytes go.
std::string size_text(const StreamReport& report);

}  // namespace hmlfc::cli
