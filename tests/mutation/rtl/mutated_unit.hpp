// The decode unit with mutants in it (plant.py).
#pragma once

#include <memory>

#include "pins.hpp"

namespace hmlfc::tb {

/// The parameters of the mutated unit; units.py and CMakeLists.txt have them as well.
inline constexpr UnitParameters kMutatedUnit{2, 12, 8, 4};

/// The unit with mutant `number` of mutants.json switched on; with 0 none is.
std::unique_ptr<DecodeUnit> make_mutated_unit(unsigned number);

}  // namespace hmlfc::tb
