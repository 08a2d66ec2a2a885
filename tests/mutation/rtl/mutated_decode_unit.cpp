// A mutated decode unit as the one Verilated unit of the bench.
#include HMLFC_MUTATED_HEADER

#include "mutated_unit.hpp"
#include "unit/units.hpp"
#include "unit/verilated_unit.hpp"

namespace hmlfc::tb {
namespace {

std::unique_ptr<DecodeUnit> make_unit(const UnitParameters& parameters) {
  return std::make_unique<VerilatedUnit<HMLFC_MUTATED>>(parameters, mutants_plusarg());
}

}  // namespace

std::string& mutants_plusarg() {
  static std::string plusarg = "+mutants=0";
  return plusarg;
}

void outlive_assertions() { Verilated::threadContextp()->fatalOnError(false); }

bool assertion_fails() { return Verilated::threadContextp()->gotError(); }

// units.py has these parameters as well.
std::vector<UnitMaker> rtl_units() { return {{"mutated", {2, 12, 8, 4}, &make_unit}}; }

std::vector<std::unique_ptr<Check>> checks(const std::filesystem::path& suite) {
  auto found = vector_checks(suite);
  for (auto& test : test_checks({})) found.push_back(std::move(test));
  return found;
}

}  // namespace hmlfc::tb
