#include "unit/dram.hpp"

#include <algorithm>

namespace hmlfc::tb {

uint64_t Dram::read_line(uint64_t address, uint64_t now) {
  const uint64_t row = address / kRowBytes / kBanks;
  Bank& bank = banks_[address / kRowBytes % kBanks];
  uint64_t asked = std::max(now, bank.free_at);
  if (bank.row != row) {
    bank.row = row;
    asked += kOpenRow;
    ++rows_opened_;
  }
  bank.free_at = asked + 1;
  const uint64_t shown = std::max(asked + kLatency, bus_free_at_);
  bus_free_at_ = shown + line_clocks_;
  ++lines_;
  return shown;
}

}  // namespace hmlfc::tb
