#include "stimulus/index_damage.hpp"

#include <algorithm>
#include <bit>

#include "bits/bit_string.hpp"
#include "bits/little_endian.hpp"
#include "syntax/index.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kGroupSection = 2;
constexpr size_t kTileSection = 3;
constexpr size_t kPlaceByte = 8;       // of `first` in a root entry, of `place` in a group record
constexpr size_t kOffsetBitsByte = 6;  // of a place
constexpr size_t kUpperByte = 7;
constexpr uint64_t kHeadBytes = 12;  // most records have their fields before the values in them

std::span<uint8_t> section_of(std::span<uint8_t> stream, const StreamHeader& header, size_t which) {
  const auto& section = header.sections[which];
  return stream.subspan(static_cast<size_t>(section.offset), static_cast<size_t>(section.size));
}

// Whether entry `i` of `count` is corrupted: entry `always`, and `permille` of the others.
bool drawn(uint64_t i, uint64_t always, unsigned permille, Random& random) {
  return random.chance(permille) || i == always;
}

// Sets the field of `count` bits at `position` of a bit string (CNV-4).
void set_field(std::span<uint8_t> bytes, uint64_t position, unsigned count, uint64_t value) {
  for (unsigned i = 0; i < count; ++i) {
    const auto byte = static_cast<size_t>((position + i) >> 3);
    const auto bit = static_cast<uint8_t>(1u << ((position + i) & 7));
    bytes[byte] =
        static_cast<uint8_t>((value >> i & 1) != 0 ? bytes[byte] | bit : bytes[byte] & ~bit);
  }
}

void corrupt_place(std::span<uint8_t> place, Random& random) {
  switch (random.below(4)) {
    case 0:
      place[kOffsetBitsByte] = 0;
      return;
    case 1:
      place[kOffsetBitsByte] = static_cast<uint8_t>(random.within(kMaxOffsetBits + 1, 255));
      return;
    case 2:
      place[kUpperByte] = static_cast<uint8_t>(random.within(1, 255));
      return;
    default:
      place[kOffsetBitsByte - 1] = static_cast<uint8_t>(random.within(1, 255));
  }
}

// The end table of an intact group: `count` entries of `width` bits, then the records.
struct EndTable {
  std::span<uint8_t> bytes;  // from the table on, to the end of the section
  unsigned count;
  unsigned width;

  uint64_t end_of(unsigned j) const { return BitString(bytes).field(uint64_t{j} * width, width); }
  uint64_t records() const { return (uint64_t{count} * width + 7) / 8; }
};

template <class Visit>
void for_each_table(std::span<uint8_t> stream, const StreamHeader& header, Visit visit) {
  const auto groups = section_of(stream, header, kGroupSection);
  const auto tiles = section_of(stream, header, kTileSection);
  for (size_t at = 0; at + kGroupRecordBytes <= groups.size(); at += kGroupRecordBytes) {
    const auto count = static_cast<unsigned>(std::popcount(load_le<uint64_t>(groups, at)));
    const uint64_t place = load_le<uint64_t>(groups, at + kPlaceByte);
    const uint64_t data = place & ((uint64_t{1} << kDataOffsetBits) - 1);
    const auto width = static_cast<unsigned>(place >> kDataOffsetBits & 0xFF);
    if (count != 0) visit(EndTable{tiles.subspan(static_cast<size_t>(data)), count, width});
  }
}

}  // namespace

void corrupt_root_entries(std::span<uint8_t> stream, const StreamHeader& header, Random& random) {
  const auto section = section_of(stream, header, 1);
  const uint64_t count = section.size() / kRootEntryBytes;
  const uint64_t always = random.below(count);
  for (uint64_t i = 0; i < count; ++i) {
    if (!drawn(i, always, 500, random)) continue;
    const auto first = section.subspan(static_cast<size_t>(i * kRootEntryBytes) + kPlaceByte);
    first[random.within(1, 7)] ^= static_cast<uint8_t>(1u << random.below(8));
  }
}

void corrupt_group_records(std::span<uint8_t> stream, const StreamHeader& header, Random& random) {
  const auto section = section_of(stream, header, kGroupSection);
  const uint64_t count = section.size() / kGroupRecordBytes;
  if (count == 0) return;
  const uint64_t always = random.below(count);
  for (uint64_t i = 0; i < count; ++i) {
    if (!drawn(i, always, 500, random)) continue;
    const auto at = static_cast<size_t>(i * kGroupRecordBytes);
    corrupt_place(section.subspan(at + kPlaceByte, 8), random);
  }
}

void corrupt_end_tables(std::span<uint8_t> stream, const StreamHeader& header, Random& random) {
  for_each_table(stream, header, [&](const EndTable& table) {
    const uint64_t always = random.below(table.count);
    uint64_t begin = 0;
    for (unsigned j = 0; j < table.count; ++j) {
      if (drawn(j, always, 250, random)) {
        set_field(table.bytes, uint64_t{j} * table.width, table.width, begin + random.below(4));
      }
      begin = table.end_of(j);
    }
  });
}

void corrupt_record_heads(std::span<uint8_t> stream, const StreamHeader& header, Random& random) {
  for_each_table(stream, header, [&](const EndTable& table) {
    uint64_t begin = 0;
    for (unsigned j = 0; j < table.count; ++j) {
      const uint64_t end = table.end_of(j);
      const auto head = static_cast<uint32_t>(std::min<uint64_t>(end - begin, kHeadBytes));
      const unsigned bits = random.chance(500) ? random.within(1, 3) : 0;
      for (unsigned i = 0; i < bits; ++i) {
        table.bytes[static_cast<size_t>(table.records() + begin + random.below(head))] ^=
            static_cast<uint8_t>(1u << random.below(8));
      }
      begin = end;
    }
  });
}

}  // namespace hmlfc::tb
