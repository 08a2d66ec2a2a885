#include "conform/stream_parts.hpp"

#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint64_t kMaxTiles = uint64_t{1} << 20;

// Calls body(place, number of the tile) for each tile, in the order of their numbers (IDX-2).
template <class Body>
void for_each_tile(const Geometry& geometry, const Body& body) {
  uint64_t number = 0;
  const auto plane_tiles = [&](TilePlace place, const auto& shape) {
    for (place.ty = 0; place.ty < shape.tiles_y; ++place.ty) {
      for (place.tx = 0; place.tx < shape.tiles_x; ++place.tx) body(place, number++);
    }
  };
  for (int level = geometry.top(); level >= 0; --level) {
    for (const ImagePos at : geometry.level(level).all_images()) {
      TilePlace place{level, at.row, at.col, 0, 0, 0};
      for (const Plane plane : kPlanes) {
        place.slot = static_cast<unsigned>(plane);
        plane_tiles(place, geometry.plane(plane));
      }
      for (const MotionPlaneShape& shape : geometry.motion_planes()) {
        ++place.slot;
        plane_tiles(place, shape);
      }
    }
  }
}

// Calls body(place, number of the plane) for each plane of each key image, in the order of TOP.
template <class Body>
void for_each_key(const Geometry& geometry, const Body& body) {
  uint64_t number = 0;
  for (int level = geometry.top(); level >= 0; --level) {
    for (const ImagePos at : geometry.level(level).all_images()) {
      if (!geometry.is_key(level, at)) continue;
      for (unsigned plane = 0; plane < kPlaneCount; ++plane) {
        body(KeyPlace{level, at.row, at.col, plane}, number++);
      }
    }
  }
}

}  // namespace

std::optional<StreamParts> take_apart(const StreamView& stream) {
  const Geometry& geometry = stream.geometry;
  if (geometry.tile_count() > kMaxTiles) return std::nullopt;
  const auto rig = stream.bytes(Section::kRig);
  StreamParts parts{stream.header, {}, {}, {rig.begin(), rig.end()}};
  const auto top = stream.bytes(Section::kTop);
  for_each_key(geometry, [&](const KeyPlace& place, uint64_t number) {
    const auto entry = static_cast<size_t>(number * kTopEntryBytes);
    const auto codestream = top.subspan(static_cast<size_t>(load_le<uint64_t>(top, entry)),
                                        load_le<uint32_t>(top, entry + 8));
    parts.keys[place] = {{codestream.begin(), codestream.end()},
                         load_le<uint32_t>(top, entry + 12)};
  });
  bool intact = true;
  const auto tiles = stream.bytes(Section::kTile);
  for_each_tile(geometry, [&](const TilePlace& place, uint64_t number) {
    const auto extent = find_tile(stream, number, Probe{});
    intact &= extent.has_value();
    if (!extent || !*extent) return;
    const auto record = tiles.subspan(static_cast<size_t>((*extent)->begin),
                                      static_cast<size_t>((*extent)->end - (*extent)->begin));
    parts.tiles[place] = {record.begin(), record.end()};
  });
  if (!intact) return std::nullopt;
  return parts;
}

std::optional<std::vector<uint8_t>> put_together(const StreamParts& parts) {
  if (!check_fields(parts.header)) return std::nullopt;
  const Geometry geometry(parts.header);
  if (geometry.tile_count() > kMaxTiles) return std::nullopt;
  std::vector<std::vector<uint8_t>> codestreams;
  std::vector<uint32_t> crcs;
  for_each_key(geometry, [&](const KeyPlace& place, uint64_t) {
    const auto key = parts.keys.find(place);
    if (key == parts.keys.end()) return;
    codestreams.push_back(key->second.codestream);
    crcs.push_back(key->second.sample_crc);
  });
  if (codestreams.size() != geometry.key_count() * kPlaneCount) return std::nullopt;
  IndexWriter index;
  for_each_tile(geometry, [&](const TilePlace& place, uint64_t) {
    const auto record = parts.tiles.find(place);
    index.add(record == parts.tiles.end() ? std::span<const uint8_t>() : record->second);
  });
  index.finish();
  return assemble_stream(parts.header, top_section(codestreams, crcs), index, parts.rig);
}

SamplePrecision key_precision(const StreamHeader& header, unsigned plane) {
  return {header.depth + (plane == 0 ? 0 : 1), plane != 0};
}

std::optional<KeyCode> key_code(const SamplePlane& samples, const StreamHeader& header,
                                unsigned plane) {
  auto codestream = encode_jpeg2000(samples, key_precision(header, plane));
  if (!codestream) return std::nullopt;
  return KeyCode{std::move(*codestream), sample_crc(samples)};
}

bool add_missing_keys(StreamParts& parts, const Decoder& decoder) {
  const StreamHeader& header = parts.header;
  const Geometry geometry(header);
  bool complete = true;
  for_each_key(geometry, [&](const KeyPlace& place, uint64_t) {
    if (!complete || parts.keys.contains(place)) return;
    ViewPos view{place.row, place.col};  // the first below the image
    for (int level = 0; level < place.level; ++level) {
      view.row *= header.cluster_rows;
      view.col *= header.cluster_cols;
    }
    const auto plane = static_cast<Plane>(place.plane);
    auto samples = decoder.decode_plane(view, plane, place.level);
    SamplePlane image(geometry.plane(plane).width, geometry.plane(plane).height);
    complete = samples && samples->size() == image.samples.size();
    if (!complete) return;
    image.samples = std::move(*samples);
    auto code = key_code(image, header, place.plane);
    complete = code.has_value();
    if (complete) parts.keys[place] = std::move(*code);
  });
  return complete;
}

}  // namespace hmlfc::conform
