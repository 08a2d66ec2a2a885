// Reading the fields of a tile record one after another (TIL-1).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <hmlfc/error.hpp>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "syntax/probe.hpp"

namespace hmlfc {

/// Reads the named fields of a tile record in turn. A field past the end of the record reads as 0
/// and sets overrun(), which the caller checks before it uses the value.
class FieldCursor {
 public:
  /// `file_bit`: address of the record's first bit from the start of the file.
  FieldCursor(const BitString& record, uint64_t file_bit, const Probe& probe)
      : record_(record), file_bit_(file_bit), probe_(probe) {}

  /// The next field of `bits` in [0, 32] bits.
  uint32_t take(std::string_view name, std::string_view clause, unsigned bits) {
    const uint32_t value = raw(bits);
    report(name, clause, bits, value);
    return value;
  }

  /// The next field of `bits` in [0, 31] bits, plus `offset`.
  int32_t take_offset(std::string_view name, std::string_view clause, unsigned bits,
                      int32_t offset) {
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

  /// Value `i` of the sequence of `count` values at bit `start`, which is there, plus `base`. The
  /// cursor stays where it is; a trace shows the sequence's first bit.
  int32_t value(std::string_view name, std::string_view clause, uint64_t start,
                const Levels& levels, uint64_t count, uint64_t i, int32_t base = 0) const {
    const auto value = base + static_cast<int32_t>(bise_value(record_, start, levels, count, i));
    const auto bits = static_cast<unsigned>(bise_bits(levels, 1));
    probe_.field(Section::kTile, file_bit(start), bits, name, clause, value);
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

  /// An error at the byte of the cursor, or of `position`.
  tl::unexpected<Error> error(ErrorCode code) const { return error_at(code, position_); }
  tl::unexpected<Error> error_at(ErrorCode code, uint64_t position) const {
    return fail(code, Section::kTile, file_byte(position));
  }

 private:
  uint32_t raw(unsigned bits) {
    const bool there = record_.holds(position_, bits);
    const uint32_t value = there ? record_.field(position_, bits) : 0;
    overrun_ = overrun_ || !there;
    position_ += bits;
    return value;
  }

  // The byte of the file in which `position` lies; past the end of the record, the byte after it.
  uint64_t file_byte(uint64_t position) const {
    return file_bit(std::min(position, record_.size())) >> 3;
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
