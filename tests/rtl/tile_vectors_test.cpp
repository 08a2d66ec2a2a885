// hmlfc_tile_vectors: least component plus value, its range and sign (TIL-6, TIL-7).
#include <array>
#include <cstdint>

#include <TileVectors.h>

#include "arithmetic/bise.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

constexpr unsigned kWordBits = 10;
constexpr unsigned kWindowBits = 256;
constexpr unsigned kBytesCode = 21;  // 256 levels: a value is a byte of the record

/// A record memory, whose bytes are the values of both components, and the unit that reads it.
class Bench {
 public:
  explicit Bench(uint32_t seed) : random_(seed) { reset(dut_); }

  Counts counts;

  /// All vectors of one tile.
  void list() {
    for (uint8_t& byte : memory_) byte = static_cast<uint8_t>(random_.often_extreme(0, 255));
    const int32_t count = random_.often_extreme(1, 64);
    window_ = random_.often_extreme(0, 127);
    least_x_ = random_.often_extreme(-window_, window_);
    least_y_ = random_.often_extreme(-window_, window_);
    const int32_t first_byte = random_.in(0, 200), skew_bytes = random_.in(0, 200);
    const int32_t context = random_.in(0, 2);
    dut_.count = static_cast<uint8_t>(count);
    dut_.codes_x = dut_.codes_y = kBytesCode;
    dut_.search_window = static_cast<uint8_t>(window_);
    put_bits(dut_.min_x, 0, 9, least_x_);
    put_bits(dut_.min_y, 0, 9, least_y_);
    random_.fill(dut_.signs, 64);
    dut_.position = static_cast<uint32_t>(8 * first_byte);
    dut_.skew = static_cast<uint16_t>(8 * skew_bytes);
    dut_.context_number = static_cast<uint8_t>(context);
    clock();
    clock();
    dut_.start = 1;
    clock();
    dut_.start = 0;
    clock();
    counts.compare(dut_.placed, 1);
    counts.compare(dut_.next, 8 * (first_byte + 2 * count));
    values_ = memory_.data() + 2048 * context + first_byte + skew_bytes;
    dut_.active = 1;
    int listed = 0;
    for (bool last = false; !last;) {
      dut_.eval();
      last = dut_.last != 0;
      if (dut_.vector_write) compare(listed++, count);
      clock();
    }
    dut_.active = 0;
    counts.compare(listed, count);
  }

 private:
  TileVectors dut_;
  Random random_;
  std::array<uint8_t, (size_t{8} << kWordBits)> memory_{};
  const uint8_t* values_ = nullptr;  ///< the horizontal components, then the vertical ones
  int32_t window_ = 0, least_x_ = 0, least_y_ = 0;

  void compare(int number, int32_t count) {
    const int32_t x = least_x_ + values_[number];
    const int32_t y = least_y_ + values_[count + number];
    counts.compare(dut_.vector_number, number);
    counts.compare(get_bits(dut_.vector_data, 17, 1), x > window_ || y > window_ ? 1 : 0);
    if (x > window_ || y > window_) return;
    counts.compare(get_signed(dut_.vector_data, 0, 8), x);
    counts.compare(get_signed(dut_.vector_data, 8, 8), y);
    counts.compare(get_bits(dut_.vector_data, 16, 1), (dut_.signs >> number) & 1);
  }

  /// A clock, in which each port reads the window that begins with its word.
  void clock() {
    dut_.eval();
    const std::array words{get_bits(dut_.read_word, 0, kWordBits),
                           get_bits(dut_.read_word, kWordBits, kWordBits)};
    tick(dut_);
    for (size_t port = 0; port < 2; ++port) {
      for (size_t i = 0; i < kWindowBits / 8; ++i) {
        put_bits(dut_.window, kWindowBits * port + 8 * i, 8,
                 memory_[(8 * words[port] + i) % memory_.size()]);
      }
    }
  }
};

TEST(TileVectors, AnyComponentsInAnyWindow) {
  static_assert(levels_of_code(kBytesCode).count == 256);
  Bench bench(11);
  for (int tile = 0; tile < 2000; ++tile) bench.list();
  expect_equal(bench.counts, 2000 * 70);
}

}  // namespace
}  // namespace hmlfc::test
