// The functions that each fuzz target defines. libFuzzer calls run with its own inputs;
// replay_main.cpp calls it with seeds made of the conformance vectors.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

namespace hmlfc::fuzz {

using Bytes = std::vector<uint8_t>;

/// Runs the code under test on any bytes. A finding ends the process: a report of a sanitizer, a
/// failed assertion or a failed demand.
void run(std::span<const uint8_t> input);

/// Inputs made of `stream`, a vector of the suite, which may be damaged. May be empty.
std::vector<Bytes> seeds(std::span<const uint8_t> stream);

/// Ends the process if a property of the code under test does not hold.
inline void demand(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "demand failed: %s\n", what);
  std::abort();
}

/// Takes integers from the front of an input; 0 past its end.
class InputReader {
 public:
  explicit InputReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  uint8_t byte() {
    if (bytes_.empty()) return 0;
    const uint8_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }
  /// A number in [lo, hi], hi - lo < 256, from one byte.
  uint32_t within(uint32_t lo, uint32_t hi) { return lo + byte() % (hi - lo + 1); }
  bool flag() { return (byte() & 1) != 0; }
  std::span<const uint8_t> rest() const { return bytes_; }

 private:
  std::span<const uint8_t> bytes_;
};

}  // namespace hmlfc::fuzz
