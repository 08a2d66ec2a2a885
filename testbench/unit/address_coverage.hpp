// How much of the width of addresses a unit's bursts have met.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "stimulus/address_space.hpp"

namespace hmlfc::tb {

/// A point and how often it was met.
struct NamedCount {
  std::string name;
  uint64_t hits;
};

/// Counts the bursts of one kind of place, such as a stream.
class AddressCoverage {
 public:
  /// A burst of `bytes` at `address`, in the place that begins at `place`.
  void on_burst(uint64_t place, uint64_t address, uint64_t bytes) {
    if (address < kPage) ++lowest_;
    if (address + bytes > AddressSpace::kEnd - kPage) ++highest_;
    if (address >> kHighBit != place >> kHighBit) ++carried_;
    for (size_t i = 0; i < kHighBits; ++i) ++bits_[i][address >> (kHighBit + i) & 1];
  }

  AddressCoverage& operator+=(const AddressCoverage& other) {
    lowest_ += other.lowest_;
    highest_ += other.highest_;
    carried_ += other.carried_;
    for (size_t i = 0; i < kHighBits; ++i) {
      for (size_t value = 0; value < 2; ++value) bits_[i][value] += other.bits_[i][value];
    }
    return *this;
  }

  /// Four points; that of the high bits counts as often as the rarest of their values.
  std::vector<NamedCount> all(const std::string& kind) const {
    uint64_t rarest = bits_[0][0];
    for (const auto& counts : bits_) rarest = std::min({rarest, counts[0], counts[1]});
    return {{kind + " in the lowest 4 KiB", lowest_},
            {kind + " in the highest 4 KiB", highest_},
            {kind + " beyond the multiple of 4 GiB after its begin", carried_},
            {kind + " with bits 39 to 32 of its address as 0 and as 1", rarest}};
  }

 private:
  static constexpr uint64_t kPage = 4096;
  static constexpr unsigned kHighBit = 32;
  static constexpr size_t kHighBits = 8;

  uint64_t lowest_ = 0;
  uint64_t highest_ = 0;
  uint64_t carried_ = 0;  // bits from 32 on are not those of the place
  std::array<std::array<uint64_t, 2>, kHighBits> bits_{};
};

}  // namespace hmlfc::tb
