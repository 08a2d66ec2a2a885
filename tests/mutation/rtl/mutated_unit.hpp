// The decode unit with mutants in it (plant.py).
#pragma once

#include <memory>
#include <span>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// The parameters of the mutated unit; units.py and CMakeLists.txt have them as well.
inline constexpr UnitParameters kMutatedUnit{2, 12, 8, 4};

/// A mutant of mutants.json: its number, from 1 on, and the variant of units.py that it is in.
struct Mutant {
  unsigned number = 0;
  unsigned variant = 0;
};

/// The unit with these mutants switched on, at most one in a variant.
std::unique_ptr<DecodeUnit> make_mutated_unit(std::span<const Mutant> mutants);

}  // namespace hmlfc::tb
