#include "unit/register_file.hpp"

#include <utility>

namespace hmlfc::tb {
namespace {

constexpr uint64_t kAddresses = (uint64_t{1} << 40) - 1;

}  // namespace

uint32_t RegisterFile::read(uint32_t offset) {
  switch (offset) {
    case reg::kId:
      return reg::kIdValue;
    case reg::kParameters:
      return reg::parameters(unit_.block_log2, unit_.max_depth, unit_.beat_bytes);
    case reg::kStatus:
      return (ready ? reg::kReady : 0) | (loading ? reg::kLoading : 0) | (idle ? reg::kIdle : 0) |
             uint32_t{load_error} << 8;
    case reg::kError:
      return error_;
    default:
      return read_pair(offset);
  }
}

uint32_t RegisterFile::read_pair(uint32_t offset) {
  const std::pair<uint32_t, uint64_t> pairs[] = {
      {reg::kStreamBase, pairs_[0]},    {reg::kStreamBytes, pairs_[1]},
      {reg::kReferenceBase, pairs_[2]}, {reg::kErrorAddress, error_word_},
      {reg::kBlocks, blocks},           {reg::kCycles, cycles},
      {reg::kStalls, stalls},           {reg::kBytesRead, bytes_read},
      {reg::kRequests, requests_}};
  for (const auto& [low, value] : pairs) {
    if (offset == low + 4) return high_word_;
    if (offset != low) continue;
    high_word_ = static_cast<uint32_t>(value >> 32);
    return static_cast<uint32_t>(value);
  }
  return 0;
}

uint32_t RegisterFile::write(uint32_t offset, uint32_t value) {
  if (offset >= reg::kStreamBase && offset < reg::kReferenceBase + 8 && offset % 4 == 0) {
    uint64_t& pair = pairs_[(offset - reg::kStreamBase) / 8];
    pair =
        offset % 8 == 0 ? (pair >> 32 << 32 | value) : (pair & 0xffffffffu) | uint64_t{value} << 32;
  }
  pairs_[0] &= kAddresses;
  pairs_[2] &= kAddresses;
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
