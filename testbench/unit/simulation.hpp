// What a Verilated model runs in: its context, what it holds at first, and the clock that it gets.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <verilated.h>

namespace hmlfc::tb {

/// One model's simulation. The model has the words of the environment variable HMLFC_RTL_PLUSARGS,
/// such as those of testbench/checker/hmlfc_checker_bind.sv.
class Simulation {
 public:
  /// Registers and memories begin with random bits, which `seed` draws, or the number in the
  /// environment variable HMLFC_RTL_STATE; in [1, 2^31 - 1].
  explicit Simulation(uint32_t seed) : seed_(seed) {
    constexpr int kRandomBits = 2;
    if (const char* text = std::getenv("HMLFC_RTL_STATE")) {
      seed_ = static_cast<uint32_t>(std::stoul(text));
    }
    context_.randReset(kRandomBits);
    context_.randSeed(static_cast<int>(seed_));
    context_.assertOn(false);
    const char* text = std::getenv("HMLFC_RTL_PLUSARGS");
    std::istringstream stream(text == nullptr ? "" : text);
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    std::vector<const char*> arguments{"unit"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    context_.commandArgs(static_cast<int>(arguments.size()), arguments.data());
  }

  VerilatedContext& context() { return context_; }
  uint32_t seed() const { return seed_; }

  /// For the name of the model, which assertions print.
  std::string setting() const { return "HMLFC_RTL_STATE=" + std::to_string(seed_); }

  /// Whether the model gets the rising edge that comes with these pins of it: from the first reset
  /// on, and after every second one, only where it is needed; after the others always.
  bool passes(bool rst_n, bool active) {
    if (!rst_n && ran_) stops_ = !stops_;
    ran_ = rst_n;
    const bool passes = active || !stops_;
    if (!passes) ++stopped_;
    return passes;
  }

  /// Edges that did not pass.
  uint64_t stopped() const { return stopped_; }

  /// After each rising edge. Assertions look at the clock before theirs, so that they begin with
  /// the second.
  void after_edge() {
    if (begun_) return;
    begun_ = true;
    context_.assertOn(true);
  }

 private:
  VerilatedContext context_;
  uint32_t seed_;
  bool begun_ = false;
  bool ran_ = true;  // there was no reset at the last edge
  bool stops_ = false;
  uint64_t stopped_ = 0;
};

}  // namespace hmlfc::tb
