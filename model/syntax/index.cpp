#include "syntax/index.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "bits/little_endian.hpp"

namespace hmlfc {
namespace {

// The record of a tile group (IDX-5).
struct GroupRecord {
  uint64_t at = 0;  // byte in the GROUP section
  uint64_t tile_mask = 0;
  uint64_t data = 0;
  unsigned offset_bits = 0;
};

// The entry of 64 tile groups (IDX-4).
struct RootEntry {
  uint64_t at = 0;  // byte in the ROOT section
  uint64_t mask = 0;
  uint64_t first = 0;  // record of the first group that has one
};

// Bit of a tile in its group's mask, or of a tile group in its root entry's.
unsigned lane_of(uint64_t number) { return static_cast<unsigned>(number % kGroupTiles); }

uint64_t bit_address(const StreamView& stream, Section section, uint64_t byte) {
  return (stream.entry(section).offset + byte) * 8;
}

// The root entry of tile group `group` (IDX-4).
Result<RootEntry> load_root_entry(const StreamView& stream, uint64_t group, const Probe& probe) {
  const uint64_t at = group / kGroupTiles * kRootEntryBytes;
  const auto bytes = stream.read(Section::kRoot, at, kRootEntryBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const RootEntry entry{at, load_le<uint64_t>(*bytes, 0), load_le<uint64_t>(*bytes, 8)};
  probe.field(Section::kRoot, bit_address(stream, Section::kRoot, at), 64, "mask", "IDX-4",
              static_cast<int64_t>(entry.mask));
  return entry;
}

// The record of the tile group at bit `lane` of `root`, which is 1 (IDX-4, IDX-5).
Result<GroupRecord> load_group(const StreamView& stream, const RootEntry& root, unsigned lane,
                               const Probe& probe) {
  probe.field(Section::kRoot, bit_address(stream, Section::kRoot, root.at) + 64, 64, "first",
              "IDX-4", static_cast<int64_t>(root.first));
  const uint64_t before = rank(root.mask, lane);
  const uint64_t records = stream.entry(Section::kGroup).size / kGroupRecordBytes;
  if (before >= records || root.first >= records - before) {
    return stream.error(ErrorCode::kBadRootEntry, Section::kRoot, root.at);
  }
  GroupRecord record;
  record.at = (root.first + before) * kGroupRecordBytes;
  const auto bytes = stream.read(Section::kGroup, record.at, kGroupRecordBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  record.tile_mask = load_le<uint64_t>(*bytes, 0);
  const uint64_t place = load_le<uint64_t>(*bytes, 8);
  record.data = place & ((uint64_t{1} << kDataOffsetBits) - 1);
  record.offset_bits = static_cast<unsigned>((place >> kDataOffsetBits) & 0xFF);

  const uint64_t address = bit_address(stream, Section::kGroup, record.at);
  probe.field(Section::kGroup, address, 64, "tile_mask", "IDX-5",
              static_cast<int64_t>(record.tile_mask));
  probe.field(Section::kGroup, address + 64, 64, "place", "IDX-5", static_cast<int64_t>(place));
  if (record.offset_bits < 1 || record.offset_bits > kMaxOffsetBits || (place >> 56) != 0) {
    return stream.error(ErrorCode::kBadGroupRecord, Section::kGroup, record.at);
  }
  return record;
}

// Reads where the record before ends, and this one, from the end table (IDX-6).
Result<TileExtent> load_extent(const StreamView& stream, const GroupRecord& group, unsigned lane,
                               const Probe& probe) {
  const uint64_t tile_bytes = stream.entry(Section::kTile).size;
  const uint64_t entries = static_cast<uint64_t>(std::popcount(group.tile_mask));
  const uint64_t table_bytes = ceil_div(entries * group.offset_bits, uint64_t{8});
  if (group.data > tile_bytes || table_bytes > tile_bytes - group.data) {
    return stream.error(ErrorCode::kBadGroupRecord, Section::kGroup, group.at);
  }
  const unsigned entry = rank(group.tile_mask, lane);
  const uint64_t from = uint64_t{entry == 0 ? 0 : entry - 1} * group.offset_bits / 8;
  const uint64_t to = ceil_div(uint64_t{entry + 1} * group.offset_bits, uint64_t{8});
  const auto bytes = stream.read(Section::kTile, group.data + from, to - from);
  if (!bytes) return tl::unexpected(bytes.error());
  const BitString ends(*bytes);
  const auto end_of = [&](unsigned number) {
    const uint64_t at = uint64_t{number} * group.offset_bits;
    const uint32_t end = ends.field(at - from * 8, group.offset_bits);
    probe.field(Section::kTile, bit_address(stream, Section::kTile, group.data) + at,
                group.offset_bits, "end", "IDX-6", end);
    return end;
  };
  const uint64_t records = group.data + table_bytes;
  const uint64_t begin = records + (entry == 0 ? 0 : end_of(entry - 1));
  const uint64_t end = records + end_of(entry);
  if (end <= begin || end > tile_bytes) {
    return stream.error(ErrorCode::kBadTileOffset, Section::kTile, group.data);
  }
  return TileExtent{begin, end};
}

}  // namespace

Result<void> check_index_sizes(const StreamView& stream) {
  const uint64_t root_bytes = stream.geometry.root_entry_count() * kRootEntryBytes;
  if (stream.entry(Section::kRoot).size != root_bytes) {
    return stream.error(ErrorCode::kBadSectionSize, Section::kRoot, 0);
  }
  if (stream.entry(Section::kGroup).size % kGroupRecordBytes != 0) {
    return stream.error(ErrorCode::kBadSectionSize, Section::kGroup, 0);
  }
  return {};
}

Result<std::optional<TileExtent>> find_tile(const StreamView& stream, uint64_t tile,
                                            const Probe& probe) {
  const uint64_t group = tile / kGroupTiles;
  const auto root = load_root_entry(stream, group, probe);
  if (!root) return tl::unexpected(root.error());
  if (!has_bit(root->mask, lane_of(group))) return std::nullopt;
  const auto record = load_group(stream, *root, lane_of(group), probe);
  if (!record) return tl::unexpected(record.error());
  if (!has_bit(record->tile_mask, lane_of(tile))) return std::nullopt;
  const auto extent = load_extent(stream, *record, lane_of(tile), probe);
  if (!extent) return tl::unexpected(extent.error());
  return *extent;
}

Result<uint64_t> next_tile(const StreamView& stream, uint64_t begin, uint64_t end) {
  for (uint64_t tile = begin; tile < end;) {
    const uint64_t group = tile / kGroupTiles;
    const auto root = load_root_entry(stream, group, Probe{});
    if (!root) return tl::unexpected(root.error());
    const uint64_t groups = root->mask >> lane_of(group);
    if (groups == 0) {
      tile = (group / kGroupTiles + 1) * kGroupTiles * kGroupTiles;
      continue;
    }
    if (const auto empty = static_cast<unsigned>(std::countr_zero(groups)); empty > 0) {
      tile = (group + empty) * kGroupTiles;
      continue;
    }
    const auto record = load_group(stream, *root, lane_of(group), Probe{});
    if (!record) return tl::unexpected(record.error());
    const uint64_t tiles = record->tile_mask >> lane_of(tile);
    if (tiles != 0) return std::min(end, tile + static_cast<unsigned>(std::countr_zero(tiles)));
    tile = (group + 1) * kGroupTiles;
  }
  return end;
}

// The record of tile number `tile` (IDX-2).
static Result<std::optional<TileRecord>> load_record(const StreamView& stream, uint64_t tile,
                                                     const Probe& probe) {
  const auto extent = find_tile(stream, tile, probe);
  if (!extent) return tl::unexpected(extent.error());
  if (!*extent) return std::nullopt;
  const auto [begin, end] = **extent;
  const auto bytes = stream.read(Section::kTile, begin, end - begin);
  if (!bytes) return tl::unexpected(bytes.error());
  return TileRecord{BitString(*bytes), bit_address(stream, Section::kTile, begin)};
}

Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe) {
  const Geometry& geometry = stream.geometry;
  const uint64_t image = geometry.image_number(site.level, {site.image_row, site.image_col});
  const uint64_t tile =
      geometry.tile_number(image, site.plane, site.bx / kTileBlocks, site.by / kTileBlocks);
  return load_record(stream, tile, probe);
}

Result<std::optional<TileRecord>> find_motion_record(const StreamView& stream,
                                                     const MotionTilePlace& place,
                                                     const Probe& probe) {
  const Geometry& geometry = stream.geometry;
  const uint64_t image = geometry.image_number(place.level, place.image);
  return load_record(
      stream, geometry.motion_tile_number(image, place.motion_plane, place.tx, place.ty), probe);
}

IndexWriter::IndexWriter(const IndexLayout& layout)
    : groups(layout.spare_records * kGroupRecordBytes),
      layout_(layout),
      first_record_(layout.spare_records) {}

void IndexWriter::add(std::span<const uint8_t> record) {
  const unsigned lane = lane_of(next_tile_);
  if (!record.empty()) {
    tile_mask_ |= uint64_t{1} << lane;
    records_.insert(records_.end(), record.begin(), record.end());
    ends_.push_back(records_.size());
  }
  ++next_tile_;
  if (lane == kGroupTiles - 1) flush_group();
}

std::vector<uint8_t> IndexWriter::take_tiles() {
  tiles_taken_ += tiles.size();
  return std::exchange(tiles, {});
}

void IndexWriter::finish() {
  if (lane_of(next_tile_) != 0) flush_group();
  if (lane_of(groups_done_) != 0) flush_root_entry();
}

void IndexWriter::flush_group() {
  if (tile_mask_ != 0 || layout_.records_of_empty) {
    const uint64_t last = ends_.empty() ? 0 : ends_.back();
    const auto offset_bits =
        std::max(layout_.least_offset_bits, static_cast<unsigned>(std::bit_width(last)));
    tiles.insert(tiles.end(), layout_.spare_bytes, 0xA5);
    append_le(groups, tile_mask_);
    append_le(groups, (tiles_taken_ + tiles.size()) | (uint64_t{offset_bits} << kDataOffsetBits));
    BitWriter table;
    for (const uint64_t end : ends_) table.put(static_cast<uint32_t>(end), offset_bits);
    tiles.insert(tiles.end(), table.bytes().begin(), table.bytes().end());
    tiles.insert(tiles.end(), records_.begin(), records_.end());
    group_mask_ |= uint64_t{1} << lane_of(groups_done_);
  }
  tile_mask_ = 0;
  ends_.clear();
  records_.clear();
  ++groups_done_;
  if (lane_of(groups_done_) == 0) flush_root_entry();
}

void IndexWriter::flush_root_entry() {
  append_le(root, group_mask_);
  append_le(root, first_record_);
  first_record_ = groups.size() / kGroupRecordBytes;
  group_mask_ = 0;
}

}  // namespace hmlfc
