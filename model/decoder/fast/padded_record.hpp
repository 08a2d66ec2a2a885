// A tile record that bise_unpack may read to its end.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bits/bit_string.hpp"
#include "decoder/fast/bise_unpack.hpp"

namespace hmlfc {

/// A copy of a record with kBiseUnpackSlack readable bytes behind it.
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
