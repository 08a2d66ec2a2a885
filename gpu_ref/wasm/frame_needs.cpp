#include "frame_needs.hpp"

#include <algorithm>
#include <bit>

#include "bits/little_endian.hpp"
#include "syntax/index.hpp"

namespace hmlfc::gpu {
namespace {

class Collector {
 public:
  explicit Collector(const StreamView& stream) : stream_(stream) {}

  // The image and all that its blocks are decoded from.
  void visit(TreeImage image) {
    if (!visited_.insert(image).second) return;
    const Geometry& geometry = stream_.geometry;
    add_image(image);
    if (geometry.is_key(image.level, image.at)) {
      needs_.keys.insert(image);
      return;
    }
    if (!geometry.is_reference(image.level, image.at)) {
      ReferenceImages references = reference_images(geometry, image.level, image.at);
      if (!stream_.header.has(Feature::kTwoReferences)) references.fill(references[0]);
      for (const ImagePos at : references) add_reference({image.level, at});
    }
    if (image.level == geometry.top()) return;
    visit({image.level + 1, geometry.ancestor(image.at, image.level, image.level + 1)});
  }

  // The ranges of the images so far, if the index is there.
  Result<FrameNeeds> finish() {
    for (const TreeImage& image : images_) {
      if (auto ok = add_tiles(image); !ok) failed_ = true;
    }
    if (failed_) return fail(ErrorCode::kBusError, Section::kGroup, 0);
    return std::move(needs_);
  }

 private:
  void add_image(TreeImage image) { images_.insert(image); }

  void add_reference(TreeImage image) {
    add_image(image);
    const bool key = stream_.geometry.is_key(image.level, image.at);
    (key ? needs_.keys : needs_.references).insert(image);
  }

  // Where the data of group record `record` begin in TILE, or where TILE ends.
  Result<uint64_t> data_of(uint64_t record) {
    const uint64_t records = stream_.entry(Section::kGroup).size / kGroupRecordBytes;
    if (record >= records) return stream_.entry(Section::kTile).size;
    const uint64_t at = record * kGroupRecordBytes;
    const auto bytes = stream_.read(Section::kGroup, at, kGroupRecordBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return load_le<uint64_t>(*bytes, 8) & ((uint64_t{1} << kDataOffsetBits) - 1);
  }

  // The tiles of one image: records of groups of 64 tiles, whose data follow each other. Where they
  // do not, or where an entry leads nowhere, all of TILE.
  Result<void> add_tiles(const TreeImage& image) {
    const Geometry& geometry = stream_.geometry;
    const uint64_t first =
        geometry.image_number(image.level, image.at) * geometry.tiles_per_image();
    const uint64_t last = first + geometry.tiles_per_image() - 1;
    uint64_t begin_record = UINT64_MAX;
    uint64_t end_record = 0;
    for (uint64_t g = first / kGroupTiles; g <= last / kGroupTiles; ++g) {
      const auto root = stream_.read(Section::kRoot, g / 64 * kRootEntryBytes, kRootEntryBytes);
      if (!root) return tl::unexpected(root.error());
      const auto mask = load_le<uint64_t>(*root, 0);
      if ((mask >> (g % 64) & 1) == 0) continue;
      const uint64_t below = mask & ((uint64_t{1} << (g % 64)) - 1);
      const uint64_t record =
          load_le<uint64_t>(*root, 8) + static_cast<uint64_t>(std::popcount(below));
      begin_record = std::min(begin_record, record);
      end_record = std::max(end_record, record + 1);
    }
    if (begin_record >= end_record) return {};
    const uint64_t records = stream_.entry(Section::kGroup).size / kGroupRecordBytes;
    end_record = std::min(end_record, records);
    if (begin_record >= end_record) return {};  // bad_root_entry
    add(Section::kGroup, begin_record * kGroupRecordBytes, end_record * kGroupRecordBytes);
    const auto begin = data_of(begin_record);
    const auto end = data_of(end_record);
    if (!begin || !end) return fail(ErrorCode::kBusError, Section::kGroup, 0);
    if (*begin < *end) {
      add(Section::kTile, *begin, *end);
    } else {
      add(Section::kTile, 0, stream_.entry(Section::kTile).size);
    }
    return {};
  }

  void add(Section section, uint64_t begin, uint64_t end) {
    const SectionEntry& entry = stream_.entry(section);
    begin = std::min(begin, entry.size);
    end = std::min(end, entry.size);
    needs_.ranges.push_back({entry.offset + begin, end - begin});
  }

  const StreamView& stream_;
  FrameNeeds needs_;
  std::set<TreeImage> visited_;
  std::set<TreeImage> images_;
  bool failed_ = false;
};

}  // namespace

Result<FrameNeeds> frame_needs(const StreamView& stream, std::array<uint32_t, 2> rows,
                               std::array<uint32_t, 2> cols, int stop_level) {
  Collector collector(stream);
  for (uint32_t row = rows[0]; row <= rows[1]; ++row) {
    for (uint32_t col = cols[0]; col <= cols[1]; ++col) {
      collector.visit({stop_level, stream.geometry.ancestor({row, col}, 0, stop_level)});
    }
  }
  return collector.finish();
}

}  // namespace hmlfc::gpu
