#include "support/streams.hpp"

#include <span>

#include "bits/crc32c.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::test {
namespace {

Bytes top_of_zeros(const StreamHeader& header, const Geometry& geometry) {
  std::vector<Bytes> codestreams;
  std::vector<uint32_t> crcs;
  for (uint64_t key = 0; key < geometry.key_count(); ++key) {
    for (const Plane plane : kPlanes) {
      const SamplePlane samples(geometry.plane(plane).width, geometry.plane(plane).height);
      const bool chroma = plane != Plane::kY;
      codestreams.push_back(
          encode_jpeg2000(samples, {header.depth + (chroma ? 1 : 0), chroma}).value());
      crcs.push_back(sample_crc(samples));
    }
  }
  return top_section(codestreams, crcs);
}

}  // namespace

int draw(std::mt19937& random, int lo, int hi) {
  return std::uniform_int_distribution(lo, hi)(random);
}

BlockAddress draw_block(vectors::Random& random, const Decoder& decoder) {
  const StreamHeader& header = decoder.header();
  const Plane plane = kPlanes[random.below(3)];
  const PlaneSize size = decoder.plane_size(plane);
  return {{random.below(header.rows), random.below(header.cols)},
          plane,
          random.below(size.width) / header.block_size(),
          random.below(size.height) / header.block_size()};
}

void patch(Bytes& bytes, size_t offset, unsigned size, uint64_t value) {
  for (unsigned i = 0; i < size; ++i) bytes[offset + i] = static_cast<uint8_t>(value >> (8 * i));
}

void seal(Bytes& file) {
  const size_t size = size_t{file[10]} + 256 * size_t{file[11]};
  if (size < 16 || size > file.size()) return;
  patch(file, size - 4, 4, crc32c(std::span(file).first(size - 4)));
}

StreamHeader some_header(int tree_height) {
  StreamHeader header;
  header.rows = 5;
  header.cols = 7;
  header.width = 100;
  header.height = 60;
  header.depth = 10;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 2;
  header.window = 16;
  header.cluster_rows = 2;
  header.cluster_cols = 3;
  header.tree_height = tree_height;
  for (int level = 0; level <= tree_height; ++level) {
    header.levels.push_back({static_cast<uint8_t>(level + 1), static_cast<uint8_t>(level + 2)});
  }
  return header;
}

StreamHeader row_of_views(int tree_height) {
  StreamHeader header = some_header(tree_height);
  header.profile = Profile::kExtended;
  header.feature_flags = 511;
  header.rows = 1;
  header.cols = 6;
  header.width = header.height = 40;
  header.window = 127;
  header.cluster_rows = 1;
  header.cluster_cols = 2;
  header.vector_precision = 1;
  header.disparity_precision = 2;
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 = 5;
  header.row_scale = 16;
  header.levels.assign(static_cast<size_t>(tree_height) + 1, {1, 1, 0});
  header.levels[0] = {1, 3, 0};
  return header;
}

Bytes file_of(StreamHeader header, const SectionBytes& sections, const Bytes& rig) {
  uint64_t offset = header_size(header);
  if (header.has(Feature::kCameraRig)) {
    header.rig = {5, crc32c(rig), offset, rig.size()};
    offset += rig.size();
  }
  for (uint32_t i = 0; i < 4; ++i) {
    header.sections[i] = {i + 1, crc32c(sections[i]), offset, sections[i].size()};
    offset += sections[i].size();
  }
  Bytes file = write_header(header);
  if (header.has(Feature::kCameraRig)) file.insert(file.end(), rig.begin(), rig.end());
  for (const Bytes& section : sections) file.insert(file.end(), section.begin(), section.end());
  return file;
}

Bytes drawn_stream(const StreamHeader& header, uint64_t seed) {
  return vectors::field_stream({header, {}, {}, {}, 0, {}, {}}, seed);
}

StreamParts::StreamParts(const StreamHeader& h)
    : header(h), geometry(h), top(top_of_zeros(h, geometry)), records(geometry.tile_count()) {}

StreamParts::StreamParts(const Bytes& file)
    : header(parse_header(file).value()), geometry(header), records(geometry.tile_count()) {
  const StreamView view{file, header, geometry};
  const auto top_bytes = view.bytes(Section::kTop);
  top.assign(top_bytes.begin(), top_bytes.end());
  const auto tiles = view.bytes(Section::kTile);
  for (uint64_t tile = 0; tile < records.size(); ++tile) {
    const auto extent = find_tile(view, tile, Probe{}).value();
    if (!extent) continue;
    const auto record = tiles.subspan(extent->begin, extent->end - extent->begin);
    records[tile].assign(record.begin(), record.end());
  }
}

Bytes& StreamParts::tile(int level, ImagePos image, Plane plane, uint32_t tx, uint32_t ty) {
  return records[geometry.tile_number(geometry.image_number(level, image), plane, tx, ty)];
}

Bytes& StreamParts::motion_tile(int level, ImagePos image, size_t m, uint32_t tx, uint32_t ty) {
  return records[geometry.motion_tile_number(geometry.image_number(level, image), m, tx, ty)];
}

Bytes StreamParts::file() const {
  IndexWriter index;
  for (const Bytes& record : records) index.add(record);
  index.finish();
  return assemble_stream(header, top, index);
}

}  // namespace hmlfc::test
