// Verilated units under test: ports as bit strings, their clock, counts of what was compared.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iostream>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <verilated.h>

#include "arithmetic/rounding.hpp"

namespace hmlfc::test {

/// Sets `width` bits in [1, 32] of `port` from bit `at` on to the low bits of `value`.
template <std::integral Port>
void put_bits(Port& port, size_t at, unsigned width, int64_t value) {
  const uint64_t mask = ((uint64_t{1} << width) - 1) << at;
  port = static_cast<Port>((port & ~mask) | ((static_cast<uint64_t>(value) << at) & mask));
}

template <size_t kWords>
void put_bits(VlWide<kWords>& port, size_t at, unsigned width, int64_t value) {
  const size_t word = at / 32;
  const auto shift = static_cast<unsigned>(at % 32);
  const uint64_t mask = ((uint64_t{1} << width) - 1) << shift;
  const uint64_t bits = (static_cast<uint64_t>(value) << shift) & mask;
  port[word] = (port[word] & ~static_cast<uint32_t>(mask)) | static_cast<uint32_t>(bits);
  if (mask >> 32 != 0) {
    port[word + 1] =
        (port[word + 1] & ~static_cast<uint32_t>(mask >> 32)) | static_cast<uint32_t>(bits >> 32);
  }
}

/// `width` bits in [1, 31] of `port` from bit `at` on.
template <std::integral Port>
uint32_t get_bits(const Port& port, size_t at, unsigned width) {
  return static_cast<uint32_t>((uint64_t{port} >> at) & ((uint64_t{1} << width) - 1));
}

template <size_t kWords>
uint32_t get_bits(const VlWide<kWords>& port, size_t at, unsigned width) {
  const size_t word = at / 32;
  uint64_t bits = port[word];
  if (at % 32 + width > 32) bits |= uint64_t{port[word + 1]} << 32;
  return static_cast<uint32_t>((bits >> (at % 32)) & ((uint64_t{1} << width) - 1));
}

/// The same in two's complement.
template <class Port>
int32_t get_signed(const Port& port, size_t at, unsigned width) {
  return sign_extend(get_bits(port, at, width), width);
}

/// One rising edge.
template <class Dut>
void tick(Dut& dut) {
  dut.clk = 0;
  dut.eval();
  dut.clk = 1;
  dut.eval();
}

/// One clock in reset.
template <class Dut>
void reset(Dut& dut) {
  dut.rst_n = 0;
  tick(dut);
  dut.rst_n = 1;
}

/// How many values were compared and how many of them differed.
struct Counts {
  uint64_t compared = 0;
  uint64_t wrong = 0;

  void compare(int64_t got, int64_t expected) {
    ++compared;
    if (got != expected) ++wrong;
  }
};

/// All equal, and at least `least` compared; the count is printed.
inline void expect_equal(const Counts& counts, uint64_t least) {
  std::cout << "compared " << counts.compared << " values\n";
  EXPECT_EQ(counts.wrong, 0u) << "of " << counts.compared;
  EXPECT_GE(counts.compared, least);
}

/// Seeded by the test itself, so that every run has the same cases.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}

  /// In [lo, hi].
  int32_t in(int32_t lo, int32_t hi) {
    return std::uniform_int_distribution<int32_t>(lo, hi)(engine_);
  }

  bool one_in(int n) { return in(1, n) == 1; }

  /// In [lo, hi], an end of it half of the time.
  int32_t often_extreme(int32_t lo, int32_t hi) {
    return one_in(2) ? in(lo, hi) : one_in(2) ? lo : hi;
  }

  /// `width` random bits of `port` from bit 0 on.
  template <class Port>
  void fill(Port& port, size_t width) {
    for (size_t at = 0; at < width; at += 16) {
      put_bits(port, at, static_cast<unsigned>(std::min<size_t>(16, width - at)), in(0, 0xFFFF));
    }
  }

 private:
  std::mt19937 engine_;
};

/// Drives a unit with `clk` and `advance` and a latency of `latency` clocks: one input a clock. One
/// clock in eight is without advance: the outputs must hold.
template <class Dut, class Expected>
class Pipeline {
 public:
  Pipeline(Dut& dut, size_t latency, Random& random)
      : dut_(dut), latency_(latency), random_(random) {}

  /// Gives the inputs a clock; `check(expected)` runs for the input whose result comes out.
  template <class Check>
  void step(Expected expected, Check&& check) {
    while (random_.one_in(8)) clock(false, check);
    in_flight_.push_back(std::move(expected));
    if (in_flight_.size() > latency_) in_flight_.pop_front();
    clock(true, check);
  }

 private:
  Dut& dut_;
  size_t latency_;
  Random& random_;
  std::deque<Expected> in_flight_;

  template <class Check>
  void clock(bool advance, Check& check) {
    dut_.advance = advance;
    tick(dut_);
    if (in_flight_.size() == latency_) check(in_flight_.front());
  }
};

}  // namespace hmlfc::test
