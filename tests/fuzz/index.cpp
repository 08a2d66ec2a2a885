// The walk through the index to the record of each tile (IDX-4 to IDX-7).
#include "syntax/index.hpp"

#include "stream_parts.hpp"
#include "syntax/header.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr uint64_t kMaxTiles = 1024;  // of one input

}  // namespace

void run(std::span<const uint8_t> input) {
  const auto header = parse_header(input);
  if (!header) return;
  const StreamView stream{input, *header, Geometry(*header)};
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

// The key images are left out.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  auto parts = split(stream);
  if (!parts) return {};
  parts->sections[0].clear();
  return {join(*parts)};
}

}  // namespace hmlfc::fuzz
