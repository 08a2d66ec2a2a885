// Reading the fields of a tile record one after another (TIL-1).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "syntax/probe.hpp"

namespace hmlfc {

/// A position in a tile record that moves over named fields. A field past the end of the record
/// reads as 0 and sets overrun(); the caller checks it before the value matters.
class FieldCursor {
 public:
  /// `file_bit`: address of the record's first bit from the start of the file.
  FieldCursor(const BitString& record, uint64_t file_bit, const Probe& probe)
      : record_(record), file_bit_(file_bit), probe_(probe) {}

  /// The next field of `bits` in [0, 32] bits, plus `offset`.
  int32_t take(std::string_view name, std::string_view clause, unsigned bits, int32_t offset = 0) {
    const int32_t value = static_cast<int32_t>(raw(bits)) + offset;
    report(name, clause, bits, value);
    return value;
  }

  /// The next field of `bits` in [0, 31] bits in two's complement.
  int32_t take_signed(std::string_view name, std::string_view clause, unsigned bits) {
    const int32_t value = sign_extend(raw(bits), bits);
    report(name, clause, bits, value);
    return value;
  }

  /// The next field of 64 bits.
  uint64_t take64(std::string_view name, std::string_view clause) {
    const uint64_t low = raw(32);
    const uint64_t value = low | (uint64_t{raw(32)} << 32);
    report(name, clause, 64, static_cast<int64_t>(value));
    return value;
  }

  /// Moves over `bits` bits without reading them.
  void skip(uint64_t bits) {
    if (!record_.holds(position_, bits)) overrun_ = true;
    position_ += bits;
  }

  void seek(uint64_t position) { position_ = position; }
  uint64_t position() const { return position_; }
  bool overrun() const { return overrun_; }
  const BitString& record() const { return record_; }
  const Probe& probe() const { return probe_; }
  uint64_t file_bit(uint64_t position) const { return file_bit_ + position; }

  /// The byte of the file in which `position` lies; past the end of the record, the byte after it.
  uint64_t file_byte(uint64_t position) const {
    return file_bit(std::min(position, record_.size())) >> 3;
  }

 private:
  uint32_t raw(unsigned bits) {
    const bool there = record_.holds(position_, bits);
    const uint32_t value = there ? record_.field(position_, bits) : 0;
    overrun_ = overrun_ || !there;
    position_ += bits;
    return value;
  }

  void report(std::string_view name, std::string_view clause, unsigned bits, int64_t value) const {
    if (overrun_) return;
    probe_.field(Section::kTile, file_bit(position_ - bits), bits, name, clause, value);
  }

  BitString record_;
  uint64_t file_bit_;
  Probe probe_;
  uint64_t position_ = 0;
  bool overrun_ = false;
};

}  // namespace hmlfc
