// The registers of the transaction-level model: what software wrote, and the counters.
#pragma once

#include <array>
#include <cstdint>

#include "oracle/request.hpp"
#include "unit/registers.hpp"

namespace hmlfc::tb {

/// Behaves as the table of registers says; the owner of the file acts on writes to CONTROL.
class RegisterFile {
 public:
  explicit RegisterFile(const UnitParameters& unit) : unit_(unit) {}

  /// A read as software sees it: reading a low word keeps the high word for the next read.
  uint32_t read(uint32_t offset);

  /// A write; for CONTROL returns its bits, else 0. CLEAR is done here.
  uint32_t write(uint32_t offset, uint32_t value);

  /// Notes an answer of request `word`.
  void count_answer(uint64_t word, uint8_t status);

  uint64_t stream_base() const { return pairs_[0]; }
  uint64_t stream_bytes() const { return pairs_[1]; }
  uint64_t reference_base() const { return pairs_[2]; }

  // Set by the owner.
  bool ready = false;
  uint8_t load_error = 0;
  uint64_t blocks = 0;
  uint64_t cycles = 0;
  uint64_t bytes_read = 0;

 private:
  uint32_t read_pair(uint32_t offset);

  UnitParameters unit_;
  std::array<uint64_t, 3> pairs_{};
  uint8_t error_ = 0;
  uint64_t error_word_ = 0;
  uint64_t requests_ = 0;
  uint32_t high_word_ = 0;
};

}  // namespace hmlfc::tb
