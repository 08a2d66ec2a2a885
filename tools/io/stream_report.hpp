// What a stream is and what its bytes are spent on, as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <hmlfc/decoder.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/statistics.hpp>

namespace hmlfc::io {

/// JSON whose keys keep the order in which they were set.
using OrderedJson = nlohmann::ordered_json;

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

/// The sections by their names in JSON.
std::array<std::pair<const char*, uint64_t>, 6> named_sections(const SectionBytes& sections);

/// The keys that encode and info share: bytes, bpp, ratio, rows, cols, width, height, profile,
/// method, sections.
OrderedJson report_json(const StreamReport& report);

/// The parameters in the header, for info: depth, chroma, block, window, cluster, tree_height,
/// tools, levels and the states of the blocks.
void add_structure(const StreamReport& report, OrderedJson& json);

/// Images of a level of which levels_json() looks for key images at most.
inline constexpr uint64_t kMostListedImages = 4096;

/// The levels of the tree from the top: level, rows, cols, ref_rows, ref_cols, key_images (their
/// number) and keys, their rows and columns: empty where the level has over kMostListedImages
/// images.
OrderedJson levels_json(const StreamHeader& header);

/// Names of the feature flags that are set.
std::vector<std::string> tools_of(const StreamHeader& header);

/// What `hmlfc info --json` prints, all of the above, disparity and rig, of the stream in `source`.
/// Reads every tile. Errors as for decoding.
Result<OrderedJson> info_json(const Decoder& decoder, ByteSource& source);

}  // namespace hmlfc::io
