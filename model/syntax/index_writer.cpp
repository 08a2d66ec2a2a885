#include "syntax/index_writer.hpp"

#include <algorithm>
#include <bit>

#include "bits/bit_writer.hpp"
#include "bits/little_endian.hpp"
#include "syntax/index.hpp"

namespace hmlfc {

IndexWriter::IndexWriter(const IndexLayout& layout)
    : groups(layout.spare_records * kGroupRecordBytes),
      layout_(layout),
      first_record_(layout.spare_records) {}

void IndexWriter::add(std::span<const uint8_t> record) {
  const uint64_t lane = next_tile_ & 63u;
  if (!record.empty()) {
    tile_mask_ |= uint64_t{1} << lane;
    records_.insert(records_.end(), record.begin(), record.end());
    ends_.push_back(records_.size());
  }
  ++next_tile_;
  if (lane == 63) flush_group();
}

void IndexWriter::finish() {
  if ((next_tile_ & 63u) != 0) flush_group();
  if ((groups_done_ & 63u) != 0) flush_root_entry();
}

void IndexWriter::flush_group() {
  if (tile_mask_ != 0 || layout_.records_of_empty) {
    const uint64_t last = ends_.empty() ? 0 : ends_.back();
    const auto end_bits =
        std::max(layout_.least_offset_bits, static_cast<unsigned>(std::bit_width(last)));
    tiles.insert(tiles.end(), layout_.spare_bytes, 0xA5);
    append_le(groups, tile_mask_);
    append_le(groups, uint64_t{tiles.size()} | (uint64_t{end_bits} << kDataOffsetBits));
    BitWriter table;
    for (const uint64_t end : ends_) table.put(static_cast<uint32_t>(end), end_bits);
    tiles.insert(tiles.end(), table.bytes().begin(), table.bytes().end());
    tiles.insert(tiles.end(), records_.begin(), records_.end());
    group_mask_ |= uint64_t{1} << (groups_done_ & 63u);
  }
  tile_mask_ = 0;
  ends_.clear();
  records_.clear();
  ++groups_done_;
  if ((groups_done_ & 63u) == 0) flush_root_entry();
}

void IndexWriter::flush_root_entry() {
  append_le(root, group_mask_);
  append_le(root, first_record_);
  first_record_ = groups.size() / kGroupRecordBytes;
  group_mask_ = 0;
}

}  // namespace hmlfc
