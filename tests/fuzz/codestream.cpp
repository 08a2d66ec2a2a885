// The codestream of a key image: its head and, if that is valid, the JPEG 2000 decoder (KEY-2).
#include <algorithm>

#include "bits/little_endian.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "target.hpp"
#include "tile_places.hpp"

namespace hmlfc::fuzz {

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  const uint32_t width = reader.within(1, 128);
  const uint32_t height = reader.within(1, 128);
  const SamplePrecision precision{static_cast<int>(reader.within(1, 16)), reader.flag()};
  // A copy of exact length, so that reads past its end are found.
  const Bytes codestream(reader.rest().begin(), reader.rest().end());
  if (!has_key_image_head(codestream, width, height, precision)) return;
  const auto plane = decode_jpeg2000(codestream, width, height);
  if (!plane) return;
  demand(plane->width == width && plane->height == height &&
             plane->samples.size() == size_t{width} * height,
         "a plane of the wrong size");
}

std::vector<Bytes> seeds(std::span<const uint8_t> file) {
  std::vector<Bytes> found;
  const auto stream = open_view(file);
  if (!stream) return found;
  const auto top = stream->bytes(Section::kTop);
  const uint64_t entries =
      std::min<uint64_t>(stream->geometry.key_count() * kPlaneCount, kMaxRecords);
  for (uint64_t i = 0; i < entries; ++i) {
    const Plane plane = kPlanes[i % kPlaneCount];
    const PlaneShape& shape = stream->geometry.plane(plane);
    if (shape.width > 128 || shape.height > 128) continue;
    const auto at = static_cast<size_t>(i * kTopEntryBytes);
    const auto codestream = top.subspan(static_cast<size_t>(load_le<uint64_t>(top, at)),
                                        load_le<uint32_t>(top, at + 8));
    const int bits = stream->header.depth + (plane == Plane::kY ? 0 : 1);
    Bytes bytes{static_cast<uint8_t>(shape.width - 1), static_cast<uint8_t>(shape.height - 1),
                static_cast<uint8_t>(bits - 1), static_cast<uint8_t>(plane == Plane::kY ? 0 : 1)};
    bytes.insert(bytes.end(), codestream.begin(), codestream.end());
    found.push_back(std::move(bytes));
  }
  return found;
}

}  // namespace hmlfc::fuzz
