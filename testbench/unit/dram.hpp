// A DDR-like memory: lines, banks and their open rows, one data bus.
#pragma once

#include <array>
#include <cstdint>

namespace hmlfc::tb {

/// When lines come, by banks and rows. Lines are served in the order in which they are asked for; a
/// line of which a part is read takes the bus as long as a whole one. There is no refresh, and no
/// other traffic. Times are in clocks of the unit, about those of DDR4 with an interconnect at
/// 200 MHz.
class Dram {
 public:
  static constexpr uint64_t kLineBytes = 64;
  static constexpr uint64_t kRowBytes = 2048;  ///< consecutive; the next row is in the next bank
  static constexpr uint64_t kBanks = 8;
  static constexpr uint64_t kLatency = 20;  ///< from an address to its line, where its row is open
  static constexpr uint64_t kOpenRow = 6;   ///< clocks more: another row of the bank was open

  /// A bus of `bus_bytes` a clock: 8, 16, 32 or 64.
  explicit Dram(unsigned bus_bytes) : line_clocks_(kLineBytes / bus_bytes) {}

  /// The line of `address` is asked for at clock `now`, not before the last one; the clock at which
  /// its first beat may be shown.
  uint64_t read_line(uint64_t address, uint64_t now);

  uint64_t lines() const { return lines_; }
  uint64_t rows_opened() const { return rows_opened_; }
  uint64_t busy_clocks() const { return lines_ * line_clocks_; }  ///< of the data bus

 private:
  struct Bank {
    uint64_t row = ~uint64_t{0};
    uint64_t free_at = 0;
  };

  uint64_t line_clocks_;
  std::array<Bank, kBanks> banks_;
  uint64_t bus_free_at_ = 0;
  uint64_t lines_ = 0;
  uint64_t rows_opened_ = 0;
};

}  // namespace hmlfc::tb
