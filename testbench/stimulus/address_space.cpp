#include "stimulus/address_space.hpp"

#include <algorithm>

namespace hmlfc::tb {

uint64_t AddressSpace::take(uint64_t bytes, uint64_t alignment, uint64_t behind) {
  const uint64_t highest = kEnd - bytes - behind;
  uint64_t begin = 0;
  do {
    begin = candidate(bytes, highest) / alignment * alignment;
  } while (!is_free(begin, begin + bytes));
  taken_.push_back({begin, begin + bytes});
  return begin;
}

uint64_t AddressSpace::candidate(uint64_t bytes, uint64_t highest) {
  switch (random_.below(8)) {
    case 0:
      return 0;
    case 1:
      return highest;
    case 2:
      return (uint64_t{random_.within(1, 255)} << 32) - random_.below(bytes);
    default:
      return random_.next() % (highest + 1);
  }
}

bool AddressSpace::is_free(uint64_t begin, uint64_t end) const {
  return std::ranges::all_of(taken_, [&](const Range& range) {
    return begin >= range.end + kApart || range.begin >= end + kApart;
  });
}

}  // namespace hmlfc::tb
