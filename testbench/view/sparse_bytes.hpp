// Bytes at places of the view unit's addresses.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hmlfc::tb {

/// What a place holds.
enum class PlaceKind : uint8_t { kRings, kStream, kArea, kPixels, kBitmap, kCount };

/// Places, apart from each other, whose bytes lie one after the other in `bytes`; a copy is a
/// picture of the whole memory.
class SparseBytes {
 public:
  struct Place {
    uint64_t address;  ///< of the first byte
    uint64_t size;     ///< bytes
    uint64_t index;    ///< of the first byte in `bytes`
    PlaceKind kind;
  };

  /// Adds a place of `size` bytes, which are 0. No address may be in two places.
  void add(PlaceKind kind, uint64_t address, uint64_t size) {
    places_[address] = {address, size, bytes.size(), kind};
    bytes.resize(bytes.size() + size);
  }

  /// Removes all places with bytes from `index` on.
  void cut(uint64_t index) {
    std::erase_if(places_, [&](const auto& entry) { return entry.second.index >= index; });
    bytes.resize(index);
  }

  /// The place with a byte at `address`, or null.
  const Place* find(uint64_t address) const {
    const auto next = places_.upper_bound(address);
    if (next == places_.begin()) return nullptr;
    const Place& place = std::prev(next)->second;
    return address - place.address < place.size ? &place : nullptr;
  }

  /// The byte at `address`, and those behind it in its place; there is one.
  std::span<uint8_t> at(uint64_t address) {
    const Place& place = *find(address);
    return std::span(bytes).subspan(place.index).first(place.size).subspan(address - place.address);
  }
  std::span<const uint8_t> at(uint64_t address) const {
    return const_cast<SparseBytes*>(this)->at(address);
  }

  std::vector<uint8_t> bytes;

 private:
  std::map<uint64_t, Place> places_;  // by address
};

}  // namespace hmlfc::tb
