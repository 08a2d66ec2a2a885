#include "mutated_unit.hpp"

#include <string>

#include <MutatedUnit.h>

#include "verilated_unit.hpp"

namespace hmlfc::tb {

std::unique_ptr<DecodeUnit> make_mutated_unit(unsigned number) {
  return std::make_unique<VerilatedUnit<MutatedUnit>>(kMutatedUnit,
                                                      "+mutant=" + std::to_string(number));
}

}  // namespace hmlfc::tb
