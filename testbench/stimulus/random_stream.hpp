// Streams by seed, intact and damaged.
#pragma once

#include <cstdint>
#include <vector>

namespace hmlfc::tb {

/// What is corrupted in a stream before it is loaded.
enum class Damage : uint8_t {
  kNone,
  kIndexAndTiles,
  kTiles,        ///< the TILE section alone, and more of it
  kRootEntries,  ///< see random_stream.cpp, as the next three
  kGroupRecords,
  kEndTables,
  kRecordHeads,
  kKeyImages,
  kVersion,
  kProfile,
  kHeaderField,
  kHeaderByte,
  kCut
};

/// Corrupts `stream`, which is intact, by `seed`. With kProfile and kHeaderField the header's CRC
/// is right again.
void corrupt(std::vector<uint8_t>& stream, Damage damage, uint64_t seed);

/// The stream of case `seed`: of a random light field of either profile, with blocks of
/// `block_size`; two seeds in 16, one of each profile, have a light field of one view. Intact.
std::vector<uint8_t> suite_stream(uint32_t seed, unsigned block_size);

/// How the stream of case `seed` is corrupted: half of them are not.
Damage suite_damage(uint32_t seed);

}  // namespace hmlfc::tb
