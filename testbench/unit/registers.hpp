// Registers of the decode unit (docs/hardware.md, table of registers).
#pragma once

#include <cstdint>
#include <utility>

namespace hmlfc::tb::reg {

inline constexpr uint32_t kId = 0x00;
inline constexpr uint32_t kParameters = 0x04;
inline constexpr uint32_t kControl = 0x08;
inline constexpr uint32_t kStatus = 0x0c;
inline constexpr uint32_t kStreamBase = 0x10;
inline constexpr uint32_t kStreamBytes = 0x18;
inline constexpr uint32_t kReferenceBase = 0x20;
inline constexpr uint32_t kError = 0x30;
inline constexpr uint32_t kErrorAddress = 0x38;
inline constexpr uint32_t kBlocks = 0x40;
inline constexpr uint32_t kCycles = 0x48;
inline constexpr uint32_t kStalls = 0x50;
inline constexpr uint32_t kBytesRead = 0x58;
inline constexpr uint32_t kRequests = 0x60;

inline constexpr uint32_t kIdValue = 0x464c4d48;  ///< "HMLF" in memory

// Bits of CONTROL and STATUS.
inline constexpr uint32_t kLoad = 1;
inline constexpr uint32_t kClear = 2;
inline constexpr uint32_t kDisable = 4;
inline constexpr uint32_t kReady = 1;
inline constexpr uint32_t kLoading = 2;
inline constexpr uint32_t kIdle = 4;
inline constexpr uint32_t kStray = 8;

/// The error of the last LOAD in a value of STATUS.
constexpr unsigned load_error(uint32_t status) { return status >> 8 & 63; }

/// The value of PARAMETERS.
constexpr uint32_t parameters(unsigned block_log2, unsigned max_depth, unsigned beat_bytes) {
  return block_log2 | max_depth << 4 | beat_bytes << 8;
}

/// Writes the registers of a stream by `write(address, word)`.
template <class Write>
void write_stream(const Write& write, uint64_t base, uint64_t bytes, uint64_t reference_base) {
  for (const auto& [address, value] :
       {std::pair{kStreamBase, base}, {kStreamBytes, bytes}, {kReferenceBase, reference_base}}) {
    write(address, static_cast<uint32_t>(value));
    write(address + 4, static_cast<uint32_t>(value >> 32));
  }
}

}  // namespace hmlfc::tb::reg
