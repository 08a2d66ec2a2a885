// What a file says before a block is decoded: opening it, with and without checking the CRCs of its
// sections; its header and what is derived from it; the walk through the index to the record of
// each tile (FIL-1 to FIL-6, IDX-1 to IDX-7).
#include <hmlfc/decoder.hpp>

#include <algorithm>

#include "stream_parts.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr uint64_t kMaxTiles = 1024;  // of one input

void check_opening(std::span<const uint8_t> input) {
  const auto strict = Decoder::open(input);
  const auto lenient = Decoder::open(input, {.check_sections = false});
  demand(lenient || !strict, "a stream opens with its CRCs checked, and not without");
  const bool crc = !strict && strict.error().code == ErrorCode::kBadSectionCrc;
  demand(strict.has_value() == lenient.has_value() || crc, "another error than that of a CRC");
  if (!strict) demand(strict.error().offset <= input.size(), "an error past the end of the file");
}

void check_header(std::span<const uint8_t> input, const StreamHeader& header) {
  demand(check_fields(header).has_value(), "a header that was read has bad fields");
  const std::vector<uint8_t> written = write_header(header);
  demand(
      written.size() <= input.size() && std::equal(written.begin(), written.end(), input.begin()),
      "a header differs after reading and writing");
  demand(conformance_level(header) >= 0, "a conformance level below 0");
  const Geometry geometry(header);
  const LevelShape& level = geometry.level(geometry.top());
  const ImagePos last{level.rows - 1, level.cols - 1};
  demand(geometry.image_number(geometry.top(), last) < geometry.image_count(), "IDX-1");
  const ImagePos corner{header.rows - 1, header.cols - 1};
  demand(geometry.ancestor(corner, 0, geometry.top()) == last, "DEC-1");
  demand(geometry.tile_group_count() <= geometry.tile_count(), "IDX-3");
}

void check_index(std::span<const uint8_t> input, const StreamHeader& header) {
  const StreamView stream{input, header, Geometry(header)};
  if (!check_index_sizes(stream)) return;
  const uint64_t tiles = stream.geometry.tile_count();
  const uint64_t step = tiles / kMaxTiles + 1;
  for (uint64_t tile = 0; tile < tiles; tile += step) {
    const auto extent = find_tile(stream, tile, Probe{});
    if (!extent) {
      demand(extent.error().offset <= input.size(), "an error past the end of the file");
    } else if (*extent) {
      demand(
          (*extent)->begin < (*extent)->end && (*extent)->end <= stream.entry(Section::kTile).size,
          "a record outside its section");
    }
  }
}

}  // namespace

void run(std::span<const uint8_t> input) {
  check_opening(input);
  const auto header = parse_header(input);
  if (!header) return;
  check_header(input, *header);
  check_index(input, *header);
}

// Once more with the section cut short that opening does not read, and without key images.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  std::vector<Bytes> found{{stream.begin(), stream.end()}};
  auto parts = split(stream);
  if (!parts) return found;
  auto without_keys = *parts;
  without_keys.sections[0].clear();
  parts->sections[3].resize(std::min<size_t>(parts->sections[3].size(), 64));
  found.push_back(join(*parts));
  found.push_back(join(without_keys));
  return found;
}

}  // namespace hmlfc::fuzz
