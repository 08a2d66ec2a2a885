// The unit with mutants in it of this program, behind the pins of the bench.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "check.hpp"

namespace hmlfc::tb {

/// The plusarg of units that are made from now on: which mutants are switched on in them, as the
/// package that plant.py writes has them; "+mutants=0" at first, none.
std::string& mutants_plusarg();

/// Of the latest decode unit: a failing assertion is told by assertion_fails() and does not end the
/// program.
void outlive_assertions();
bool assertion_fails();

/// What must find its mutants; `suite` is the folder of the vectors. Throws std::runtime_error
/// where that is damaged.
std::vector<std::unique_ptr<Check>> checks(const std::filesystem::path& suite);

}  // namespace hmlfc::tb
