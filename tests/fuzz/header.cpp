// The header, and what is derived from it.
#include "syntax/header.hpp"

#include <algorithm>

#include "stream_parts.hpp"
#include "syntax/geometry.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {

void run(std::span<const uint8_t> input) {
  const auto header = parse_header(input);
  if (!header) {
    demand(header.error().offset <= input.size(), "an error past the end of the file");
    return;
  }
  demand(check_fields(*header).has_value(), "a header that was read has bad fields");
  const std::vector<uint8_t> written = write_header(*header);
  demand(
      written.size() <= input.size() && std::equal(written.begin(), written.end(), input.begin()),
      "a header differs after reading and writing");
  demand(conformance_level(*header) >= 0, "a conformance level below 0");
  const Geometry geometry(*header);
  const LevelShape& level = geometry.level(geometry.top());
  const ImagePos last{level.rows - 1, level.cols - 1};
  demand(geometry.image_number(geometry.top(), last) < geometry.image_count(), "IDX-1");
  const ImagePos corner{header->rows - 1, header->cols - 1};
  demand(geometry.ancestor(corner, 0, geometry.top()) == last, "DEC-1");
  demand(geometry.tile_group_count() <= geometry.tile_count(), "IDX-3");
}

std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  auto parts = split(stream);
  if (!parts) return {{stream.begin(), stream.end()}};
  parts->sections = {};
  return {join(*parts)};
}

}  // namespace hmlfc::fuzz
