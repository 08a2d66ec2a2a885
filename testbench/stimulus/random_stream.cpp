#include "stimulus/random_stream.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "bits/bit_string.hpp"
#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "oracle/reference_area.hpp"
#include "scenes/test_light_fields.hpp"
#include "stimulus/conditions.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kCrcBytes = 4;
constexpr size_t kVersionByte = 8;  // FIL-1
constexpr size_t kProfileByte = 9;
constexpr uint32_t kOneViewSeeds = 14;  // of 16; so has the next seed

// Changes bytes of [begin, end) of `bytes`, about one in `spacing`, at least one.
void change_bytes(std::vector<uint8_t>& bytes, uint64_t begin, uint64_t end, uint64_t spacing,
                  Random& random) {
  if (begin >= end) return;
  const uint64_t count = 1 + (end - begin) / spacing;
  for (uint64_t i = 0; i < count; ++i) {
    bytes[static_cast<size_t>(begin + random.below(end - begin))] ^=
        static_cast<uint8_t>(1u << random.below(8));
  }
}

void repair_header_crc(std::vector<uint8_t>& bytes, size_t header_bytes) {
  const size_t at = header_bytes - kCrcBytes;
  set_field(bytes, 8 * at, 8 * kCrcBytes, crc32c(std::span(bytes).first(at)));
}

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

// Root entries, one in two and at least one, get a `first` beyond the GROUP section
// (bad_root_entry).
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

// Group records, one in two and at least one, get offset_bits or upper bits that they must not
// have (bad_group_record), or lose their end table beyond the section.
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

// End tables of intact groups: entries, one in four and at least one of each table, leave their
// record 0 to 3 bytes, so that it ends within its fixed fields, or before it begins.
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

// The first bytes of tile records of intact groups, where the modes, masks, bounds and codes are:
// one record in two gets one to three wrong bits there.
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

}  // namespace

std::vector<uint8_t> suite_stream(uint32_t seed, unsigned block_size) {
  auto made = test::random_case_of_any_profile(seed);
  if (seed % 16 >= kOneViewSeeds) made.shape.rows = made.shape.cols = 1;
  made.params.block_size = block_size;
  made.params.threads = 1;
  return encode(test::textured_light_field(made.shape, seed, made.noise), made.params)->bytes;
}

Damage suite_damage(uint32_t seed) {
  constexpr std::array kDamages{
      Damage::kNone, Damage::kRecordHeads, Damage::kNone, Damage::kEndTables,
      Damage::kNone, Damage::kRootEntries, Damage::kNone, Damage::kGroupRecords,
      Damage::kNone, Damage::kRecordHeads, Damage::kNone, Damage::kIndexAndTiles,
      Damage::kNone, Damage::kKeyImages,   Damage::kNone, Damage::kTiles,
      Damage::kNone, Damage::kHeaderField, Damage::kNone, Damage::kCut,
      Damage::kNone, Damage::kHeaderByte};
  // Seeds alternate between the profiles; so do the damages of each profile.
  return kDamages[(seed / 2 + seed % 2) % kDamages.size()];
}

void corrupt(std::vector<uint8_t>& stream, Damage damage, uint64_t seed) {
  Random random(seed);
  const auto header = parse_header(stream);
  if (!header) return;
  const size_t header_bytes = header_size(*header);
  const auto& top = header->sections[0];
  switch (damage) {
    case Damage::kNone:
      return;
    case Damage::kIndexAndTiles:
      change_bytes(stream, top.offset + top.size, stream.size(), 300, random);
      return;
    case Damage::kTiles:
      change_bytes(stream, header->sections[3].offset, stream.size(), 30, random);
      return;
    case Damage::kRootEntries:
      return corrupt_root_entries(stream, *header, random);
    case Damage::kGroupRecords:
      return corrupt_group_records(stream, *header, random);
    case Damage::kEndTables:
      return corrupt_end_tables(stream, *header, random);
    case Damage::kRecordHeads:
      return corrupt_record_heads(stream, *header, random);
    case Damage::kVersion:
      stream[kVersionByte] ^= static_cast<uint8_t>(random.within(1, 255));
      return;
    case Damage::kProfile:
      stream[kProfileByte] = static_cast<uint8_t>(random.within(2, 255));
      return repair_header_crc(stream, header_bytes);
    case Damage::kKeyImages: {
      const uint64_t table = Geometry(*header).key_count() * kPlaneCount * kTopEntryBytes;
      change_bytes(stream, top.offset + table, top.offset + top.size, 3000, random);
      return;
    }
    case Damage::kHeaderField:
      change_bytes(stream, 12, header_bytes - kCrcBytes, 1000, random);
      repair_header_crc(stream, header_bytes);
      return;
    case Damage::kHeaderByte:
      change_bytes(stream, 0, header_bytes, 1000, random);
      return;
    case Damage::kCut:
      stream.resize(random.below(stream.size()));
  }
}

}  // namespace hmlfc::tb
