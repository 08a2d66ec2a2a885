// Bytes at places of a unit's addresses.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hmlfc::tb {

/// Places, apart from each other, whose bytes lie one after the other in `bytes`; a copy is a
/// picture of the whole memory.
class SparseBytes {
 public:
  /// Adds a place of `size` bytes, at least 1, which are 0. No address may be in two places.
  void add(uint64_t address, uint64_t size) {
    places_[address] = {address, size, bytes.size()};
    bytes.resize(bytes.size() + size);
  }

  /// Removes all places with bytes from `index` on.
  void cut(uint64_t index) {
    std::erase_if(places_, [&](const auto& entry) { return entry.second.index >= index; });
    bytes.resize(index);
  }

  /// Whether a place has a byte at `address`, or ends fewer than `behind` bytes before it.
  bool has(uint64_t address, uint64_t behind = 0) const {
    const Place* place = before(address);
    return place != nullptr && address - place->address < place->size + behind;
  }

  /// The byte at `address`, and those after it in its place; there is one.
  std::span<uint8_t> at(uint64_t address) {
    const Place& place = *before(address);
    return std::span(bytes).subspan(place.index).first(place.size).subspan(address - place.address);
  }
  std::span<const uint8_t> at(uint64_t address) const {
    return const_cast<SparseBytes*>(this)->at(address);
  }

  std::vector<uint8_t> bytes;

 private:
  struct Place {
    uint64_t address;  // of the first byte
    uint64_t size;     // bytes
    uint64_t index;    // of the first byte in `bytes`
  };

  // The last place that begins at `address` or before it, or null.
  const Place* before(uint64_t address) const {
    const auto next = places_.upper_bound(address);
    return next == places_.begin() ? nullptr : &std::prev(next)->second;
  }

  std::map<uint64_t, Place> places_;  // by address
};

}  // namespace hmlfc::tb
