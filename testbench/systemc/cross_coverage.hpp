// Crosses of what the unit has shown: blocks in its trace, and answers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "oracle/level_record.hpp"
#include "unit/address_coverage.hpp"

namespace hmlfc::tb {

/// Kinds of blocks, a bit each: five states, of Y and of chroma.
using BlockKinds = uint16_t;

/// The bit of a block.
BlockKinds kind_of_block(const LevelRecord& block);

/// Counts 336 combinations of what the unit did: the kind of an answer's status, or of a block that
/// the trace has shown for it; block size, profile and chroma format; whether the answer waited for
/// ready.
class CrossCoverage {
 public:
  /// A right answer of the unit, to a stream that LOAD took; `shown`: blocks without error that the
  /// trace has shown for it, and rightly.
  void on_answer(uint8_t status, BlockKinds shown, const StreamHeader& header, bool waited);

  std::vector<NamedCount> all() const;

 private:
  static constexpr size_t kStreams = 3 * 2 * 2;  // block sizes, profiles, chroma formats
  static constexpr size_t kBlockKinds = 5 * 2;   // states, with that of key images; Y and chroma
  static constexpr size_t kStatuses = 4;

  std::array<std::array<std::array<uint64_t, kBlockKinds + kStatuses>, 2>, kStreams> hits_{};
};

}  // namespace hmlfc::tb
