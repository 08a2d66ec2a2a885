#include "unit/register_file.hpp"

namespace hmlfc::tb {

uint32_t RegisterFile::low_word(uint64_t value) {
  high_word_ = static_cast<uint32_t>(value >> 32);
  return static_cast<uint32_t>(value);
}

uint32_t RegisterFile::read(uint32_t offset) {
  switch (offset) {
    case reg::kId:
      return reg::kIdValue;
    case reg::kParameters:
      return reg::parameters(unit_.block_log2, unit_.max_depth, unit_.beat_bytes);
    case reg::kStatus:
      return (ready ? reg::kReady : 0) | (loading ? reg::kLoading : 0) | (idle ? reg::kIdle : 0) |
             uint32_t{load_error} << 8;
    case reg::kStreamBase:
    case reg::kStreamBytes:
    case reg::kReferenceBase:
      return low_word(pairs_[(offset - reg::kStreamBase) / 8]);
    case reg::kError:
      return error_;
    case reg::kErrorAddress:
      return low_word(error_word_);
    case reg::kBlocks:
      return low_word(blocks);
    case reg::kCycles:
      return low_word(cycles);
    case reg::kStalls:
      return low_word(stalls);
    case reg::kBytesRead:
      return low_word(bytes_read);
    case reg::kRequests:
      return low_word(requests_);
    case reg::kStreamBase + 4:
    case reg::kStreamBytes + 4:
    case reg::kReferenceBase + 4:
    case reg::kErrorAddress + 4:
    case reg::kBlocks + 4:
    case reg::kCycles + 4:
    case reg::kStalls + 4:
    case reg::kBytesRead + 4:
    case reg::kRequests + 4:
      return high_word_;
    default:
      return 0;
  }
}

uint32_t RegisterFile::write(uint32_t offset, uint32_t value) {
  if (offset >= reg::kStreamBase && offset < reg::kReferenceBase + 8 && offset % 4 == 0) {
    uint64_t& pair = pairs_[(offset - reg::kStreamBase) / 8];
    pair =
        offset % 8 == 0 ? (pair >> 32 << 32 | value) : (pair & 0xffffffffu) | uint64_t{value} << 32;
  }
  if (offset != reg::kControl) return 0;
  if ((value & reg::kClear) != 0) {
    blocks = cycles = stalls = bytes_read = requests_ = 0;
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
