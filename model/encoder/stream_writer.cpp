#include "encoder/stream_writer.hpp"

#include <vector>

#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

// Appends the tile records of one plane to the index.
void add_records(IndexWriter& index, const PlaneCode& code, uint64_t tiles) {
  size_t at = 0;
  for (size_t tile = 0; tile < tiles; ++tile) {
    const uint32_t size = tile < code.record_sizes.size() ? code.record_sizes[tile] : 0;
    index.add(std::span(code.records).subspan(at, size));
    at += size;
  }
}

// The index of all images; the section TILE goes to `tiles` bit by bit.
IndexWriter write_index(const Geometry& geometry, const CodedRecords& records,
                        const ByteSink& tiles) {
  IndexWriter index;
  for (size_t image = 0; image < records.count(); ++image) {
    records.visit(image, [&](const ImageCode& code) {
      for (const Plane plane : kPlanes) {
        add_records(index, code[static_cast<size_t>(plane)], geometry.plane(plane).tiles());
      }
      if (!geometry.motion_planes().empty()) {
        add_records(index, code[kMotionPlane], geometry.motion_planes()[0].tiles());
      }
    });
    tiles(index.take_tiles());
  }
  index.finish();
  tiles(index.take_tiles());
  return index;
}

std::vector<uint8_t> top_table(const CodedKeys& keys) {
  std::vector<uint8_t> table;
  uint64_t offset = keys.count() * kTopEntryBytes;
  for (size_t plane = 0; plane < keys.count(); ++plane) {
    append_le(table, offset);
    append_le(table, keys.size(plane));
    append_le(table, keys.crc(plane));
    offset += keys.size(plane);
  }
  return table;
}

void write_top(const CodedKeys& keys, const ByteSink& sink) {
  sink(top_table(keys));
  for (size_t plane = 0; plane < keys.count(); ++plane) sink(keys.codestream(plane));
}

}  // namespace

void write_stream(const StreamHeader& header, const CodedImages& images,
                  std::span<const uint8_t> rig, const ByteSink& sink) {
  const Geometry geometry(header);
  SectionSums sums;
  auto& [top, root, group, tile, rig_sum] = sums;
  write_top(images.keys, [&](std::span<const uint8_t> bytes) { top.add(bytes); });
  const IndexWriter index = write_index(geometry, images.records,
                                        [&](std::span<const uint8_t> bytes) { tile.add(bytes); });
  root.add(index.root);
  group.add(index.groups);
  rig_sum.add(rig);
  sink(write_header(with_sections(header, sums)));
  if (header.has(Feature::kCameraRig)) sink(rig);
  write_top(images.keys, sink);
  sink(index.root);
  sink(index.groups);
  write_index(geometry, images.records, sink);
}

}  // namespace hmlfc
