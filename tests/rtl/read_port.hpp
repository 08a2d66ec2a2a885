// The memory that a Verilated module reads from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rtl/ports.hpp"

namespace hmlfc::test {

/// The memory that one client reads, 16 bytes a beat: beats come one by one, with gaps,
/// and some are corrupted on demand. It holds one file, at kBase, and zeros elsewhere.
class ReadPort {
 public:
  static constexpr uint64_t kBase = 0x12340;  ///< a multiple of 16
  static constexpr uint8_t kBusError = 27;    ///< annex A

  ReadPort(const std::vector<uint8_t>& file, Random& random) : file_(file), random_(random) {}

  bool corrupt = false;    ///< one beat in six is an error and carries anything
  bool corrupted = false;  ///< one was given
  uint64_t requests = 0;   ///< since the last walk began

  /// Sets the inputs of `dut` for the next clock.
  template <class Dut>
  void drive(Dut& dut) {
    const bool ready = beats_ == 0 && random_.one_in(2);
    const bool valid = beats_ != 0 && random_.one_in(2);
    const bool error = valid && corrupt && random_.one_in(6);
    put_bits(dut.response, kReadyBit, 1, ready);
    put_bits(dut.response, kValidBit, 1, valid);
    if (!valid) return;
    put_bits(dut.response, kLastBit, 1, beats_ == 1);
    put_bits(dut.response, kErrorBit, 1, error);
    corrupted |= error;
    for (size_t i = 0; i < kBeat; ++i) {
      const uint64_t at = address_ + i - kBase;
      const uint32_t byte = at < file_.size() ? file_[static_cast<size_t>(at)] : 0;
      const auto anything = static_cast<uint32_t>(random_.in(0, 255));
      put_bits(dut.data, 8 * i, 8, error ? anything : byte);
    }
    address_ += kBeat;
    --beats_;
  }

  /// Takes the request that passes at the next clock, after eval.
  template <class Dut>
  void watch(const Dut& dut) {
    if (dut.request >> kRequestValidBit == 0 || get_bits(dut.response, kReadyBit, 1) == 0) return;
    address_ = dut.request >> kBeatsBits & kAddressMask;
    beats_ = get_bits(dut.request, 0, kBeatsBits);
    EXPECT_EQ(address_ % kBeat, 0u);
    ++requests;
  }

 private:
  static constexpr size_t kBeat = 16;
  // hmlfc_pkg::read_response_t
  static constexpr size_t kReadyBit = 3, kValidBit = 2, kLastBit = 1, kErrorBit = 0;
  // hmlfc_pkg::read_request_t
  static constexpr unsigned kBeatsBits = 10, kRequestValidBit = 50;
  static constexpr uint64_t kAddressMask = (uint64_t{1} << 40) - 1;

  const std::vector<uint8_t>& file_;
  Random& random_;
  uint64_t address_ = 0;
  uint64_t beats_ = 0;
};

}  // namespace hmlfc::test
