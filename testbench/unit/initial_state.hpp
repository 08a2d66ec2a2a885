// What the registers and memories of a Verilated unit hold before its first reset.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

#include <verilated.h>

namespace hmlfc::tb {

/// Models that are made in `context` from now on begin with random bits, which `seed` draws, or
/// the number in the environment variable HMLFC_RTL_STATE; in [1, 2^31 - 1].
class InitialState {
 public:
  InitialState(VerilatedContext& context, uint32_t seed) : context_(context), seed_(seed) {
    constexpr int kRandomBits = 2;
    if (const char* text = std::getenv("HMLFC_RTL_STATE")) {
      seed_ = static_cast<uint32_t>(std::stoul(text));
    }
    context_.randReset(kRandomBits);
    context_.randSeed(static_cast<int>(seed_));
    context_.assertOn(false);
  }

  /// After each rising edge. Assertions look at the clock before theirs, so that they begin with
  /// the second.
  void after_edge() {
    if (begun_) return;
    begun_ = true;
    context_.assertOn(true);
  }

  uint32_t seed() const { return seed_; }

  /// For the name of the model, which assertions print.
  std::string setting() const { return "HMLFC_RTL_STATE=" + std::to_string(seed_); }

 private:
  VerilatedContext& context_;
  uint32_t seed_;
  bool begun_ = false;
};

}  // namespace hmlfc::tb
