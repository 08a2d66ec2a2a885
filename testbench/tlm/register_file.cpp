#include "tlm/register_file.hpp"

#include <utility>

namespace hmlfc::tb {

uint32_t RegisterFile::read(uint32_t offset) {
  switch (offset) {
    case HMLFC_REG_ID:
      return HMLFC_REG_ID_RESET;
    case HMLFC_REG_PARAMETERS:
      return reg::parameters(unit_.block_log2, unit_.max_depth, unit_.beat_bytes);
    case HMLFC_REG_STATUS:
      return HMLFC_REG_STATUS_IDLE_MASK | (ready ? HMLFC_REG_STATUS_READY_MASK : 0) |
             uint32_t{load_error} << HMLFC_REG_STATUS_LOAD_ERROR_SHIFT;
    case HMLFC_REG_ERROR:
      return error_;
    default:
      return read_pair(offset);
  }
}

uint32_t RegisterFile::read_pair(uint32_t offset) {
  const std::pair<uint32_t, uint64_t> pairs[] = {{HMLFC_REG_STREAM_BASE, pairs_[0]},
                                                 {HMLFC_REG_STREAM_BYTES, pairs_[1]},
                                                 {HMLFC_REG_REFERENCE_BASE, pairs_[2]},
                                                 {HMLFC_REG_ERROR_ADDRESS, error_word_},
                                                 {HMLFC_REG_BLOCKS, blocks},
                                                 {HMLFC_REG_CYCLES, cycles},
                                                 {HMLFC_REG_BYTES_READ, bytes_read},
                                                 {HMLFC_REG_REQUESTS, requests_}};
  for (const auto& [low, value] : pairs) {
    if (offset == low + 4) return high_word_;
    if (offset != low) continue;
    high_word_ = static_cast<uint32_t>(value >> 32);
    return static_cast<uint32_t>(value);
  }
  return 0;
}

uint32_t RegisterFile::write(uint32_t offset, uint32_t value) {
  if (offset >= HMLFC_REG_STREAM_BASE && offset < HMLFC_REG_REFERENCE_BASE + 8 && offset % 4 == 0) {
    uint64_t& pair = pairs_[(offset - HMLFC_REG_STREAM_BASE) / 8];
    pair =
        offset % 8 == 0 ? (pair >> 32 << 32 | value) : (pair & 0xffffffffu) | uint64_t{value} << 32;
  }
  pairs_[0] &= HMLFC_REG_STREAM_BASE_MASK;
  pairs_[2] &= HMLFC_REG_REFERENCE_BASE_MASK;
  if (offset != HMLFC_REG_CONTROL) return 0;
  if ((value & HMLFC_REG_CONTROL_CLEAR_MASK) != 0) {
    blocks = cycles = bytes_read = requests_ = 0;
    error_ = 0;
    error_word_ = 0;
  }
  return value;
}

void RegisterFile::count_answer(uint64_t word, uint8_t status) {
  ++requests_;
  if (status == 0 || error_ != 0) return;
  error_ = status;
  error_word_ = word;
}

}  // namespace hmlfc::tb
