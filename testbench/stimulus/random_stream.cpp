#include "stimulus/random_stream.hpp"

#include <array>
#include <span>

#include "bits/crc32c.hpp"
#include "decoder/key_images.hpp"
#include "scenes/test_light_fields.hpp"
#include "stimulus/conditions.hpp"
#include "stimulus/index_damage.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kCrcBytes = 4;
constexpr size_t kVersionByte = 8;  // FIL-1
constexpr size_t kProfileByte = 9;
constexpr uint32_t kOneViewSeeds = 14;  // and the next, of 16

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
  const uint32_t crc = crc32c(std::span(bytes).first(header_bytes - kCrcBytes));
  for (size_t i = 0; i < kCrcBytes; ++i) {
    bytes[header_bytes - kCrcBytes + i] = static_cast<uint8_t>(crc >> (8 * i));
  }
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
  const size_t header_bytes = header_size(header->tree_height);
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
