// What software does with the registers of the decode unit (docs/decode_unit.md).
#pragma once

#include <cstdint>
#include <utility>

#include "driver/hmlfc_registers.h"

namespace hmlfc::tb::reg {

/// The error of the last LOAD in a value of STATUS.
constexpr unsigned load_error(uint32_t status) {
  return (status & HMLFC_REG_STATUS_LOAD_ERROR_MASK) >> HMLFC_REG_STATUS_LOAD_ERROR_SHIFT;
}

/// The value of PARAMETERS.
constexpr uint32_t parameters(unsigned block_log2, unsigned max_depth, unsigned beat_bytes) {
  return block_log2 << HMLFC_REG_PARAMETERS_BLOCK_LOG2_SHIFT |
         max_depth << HMLFC_REG_PARAMETERS_MAX_DEPTH_SHIFT |
         beat_bytes << HMLFC_REG_PARAMETERS_BEAT_BYTES_SHIFT;
}

/// Writes the registers of a stream by `write(address, word)`.
template <class Write>
void write_stream(const Write& write, uint64_t base, uint64_t bytes, uint64_t reference_base) {
  for (const auto& [address, value] : {std::pair{HMLFC_REG_STREAM_BASE, base},
                                       {HMLFC_REG_STREAM_BYTES, bytes},
                                       {HMLFC_REG_REFERENCE_BASE, reference_base}}) {
    write(address, static_cast<uint32_t>(value));
    write(address + 4, static_cast<uint32_t>(value >> 32));
  }
}

}  // namespace hmlfc::tb::reg
