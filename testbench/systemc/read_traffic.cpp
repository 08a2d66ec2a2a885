#include "systemc/read_traffic.hpp"

#include <algorithm>

namespace hmlfc::tb {

ReadTraffic::ReadTraffic(const MemoryImage& image, const StreamHeader& header,
                         const AreaLayout& layout) {
  const auto add_section = [&](Section section, ReadPart part) {
    const SectionEntry& entry = header.sections[static_cast<size_t>(section) - 1];
    const uint64_t begin = image.stream_base + entry.offset;
    ranges_.push_back({begin, begin + entry.size, part});
  };
  add_section(Section::kRoot, ReadPart::kRoot);
  add_section(Section::kGroup, ReadPart::kGroup);
  add_section(Section::kTile, ReadPart::kTile);
  for (const AreaPlane& plane : layout.planes) {
    const uint64_t begin = image.reference_base + plane.offset;
    ranges_.push_back({begin, begin + plane.size,
                       plane.plane == Plane::kY ? ReadPart::kLuma : ReadPart::kChroma});
  }
  std::ranges::sort(ranges_, {}, &Range::begin);
}

void ReadTraffic::add(uint64_t address, unsigned beats, unsigned beat_bytes) {
  for (unsigned i = 0; i < beats; ++i, address += beat_bytes) {
    PartTraffic& part = parts_[static_cast<size_t>(part_at(address))];
    part.bytes += beat_bytes;
    if (!seen_.insert(address).second) part.again += beat_bytes;
  }
}

ReadPart ReadTraffic::part_at(uint64_t address) const {
  const auto next = std::ranges::upper_bound(ranges_, address, {}, &Range::begin);
  if (next == ranges_.begin()) return ReadPart::kOther;
  const Range& range = *std::prev(next);
  return address < range.end ? range.part : ReadPart::kOther;
}

}  // namespace hmlfc::tb
