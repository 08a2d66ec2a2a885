// Fast reading of whole sequences, equal to bise_value for every input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arithmetic/bise.hpp"
#include "bits/bit_string.hpp"

namespace hmlfc {
/// Bytes past the end of a sequence that bise_unpack may read; their content does not matter.
inline constexpr size_t kBiseUnpackSlack = 8;

/// Writes the `count` values of the sequence at bit `start` of `bytes` to `out`. The bytes up to
/// the sequence's end and kBiseUnpackSlack bytes more must be readable.
void bise_unpack(const uint8_t* bytes, uint64_t start, const Levels& levels, size_t count,
                 uint16_t* out);

/// A copy of a record with kBiseUnpackSlack readable bytes after it.
class PaddedRecord {
 public:
  explicit PaddedRecord(std::span<const uint8_t> record) : size_(record.size()) {
    bytes_.reserve(size_ + kBiseUnpackSlack);
    bytes_.assign(record.begin(), record.end());
    bytes_.resize(size_ + kBiseUnpackSlack);
  }
  const uint8_t* data() const { return bytes_.data(); }
  BitString bits() const { return BitString(std::span(bytes_).first(size_)); }

 private:
  size_t size_;
  std::vector<uint8_t> bytes_;
};

}  // namespace hmlfc
