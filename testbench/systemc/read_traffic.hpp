// Counts the bytes that a unit reads, by part of the stream and of the reference area.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <hmlfc/format.hpp>

#include "oracle/reference_area.hpp"
#include "systemc/bench.hpp"

namespace hmlfc::tb {

/// A part of what lies in memory.
enum class ReadPart : uint8_t { kRoot, kGroup, kTile, kLuma, kChroma, kOther };
inline constexpr std::array<std::string_view, 6> kReadPartNames{"root", "group",  "tile",
                                                                "luma", "chroma", "other"};

/// Bytes of the beats of one part, since the beginning.
struct PartTraffic {
  uint64_t bytes = 0;
  uint64_t again = 0;  ///< bytes of beats that had been read before
};

/// Counts bursts. A unit that read every beat that it needs once would have no byte `again`.
class ReadTraffic {
 public:
  /// For memory with `image`, a stream with `header` and an area of `layout`. A beat with bytes of
  /// two parts counts for the part of its first byte.
  ReadTraffic(const MemoryImage& image, const StreamHeader& header, const AreaLayout& layout);

  void add(uint64_t address, unsigned beats, unsigned beat_bytes);
  const PartTraffic& of(ReadPart part) const { return parts_[static_cast<size_t>(part)]; }

 private:
  struct Range {
    uint64_t begin;
    uint64_t end;
    ReadPart part;
  };

  ReadPart part_at(uint64_t address) const;

  std::vector<Range> ranges_;  // by address
  std::array<PartTraffic, kReadPartNames.size()> parts_{};
  std::unordered_set<uint64_t> seen_;  // addresses of beats
};

}  // namespace hmlfc::tb
