#include "mutated_unit.hpp"

#include <string>

#include <MutatedUnit.h>
#include <fmt/format.h>

#include "unit/verilated_unit.hpp"

namespace hmlfc::tb {

// A plusarg of 16 bits for each variant, in hexadecimal, the first variant last.
std::unique_ptr<DecodeUnit> make_mutated_unit(std::span<const Mutant> mutants) {
  std::string digits = "0";
  for (const Mutant& mutant : mutants) {
    const size_t end = 4 * (size_t{mutant.variant} + 1);
    if (digits.size() < end) digits.insert(0, end - digits.size(), '0');
    digits.replace(digits.size() - end, 4, fmt::format("{:04x}", mutant.number));
  }
  return std::make_unique<VerilatedUnit<MutatedUnit>>(kMutatedUnit, "+mutants=" + digits);
}

}  // namespace hmlfc::tb
