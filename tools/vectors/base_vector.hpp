// The valid vector that a decoder must decode before its refusal of another one counts.
#pragma once

#include <vector>

#include "vectors/manifest.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::vectors {

/// The base of `refused`, whose outcome is not ok. If its recipe edits another, the first vector
/// with outcome ok on the way through its bases; otherwise the vector of `all` that is most like
/// it: of its profile and at most its level, the most of its flags, then of its clauses, then the
/// fewest other flags, then bytes. Throws TextError if there is none.
VectorId base_of(const Vector& refused, const Recipes& recipes, const std::vector<Vector>& all);

}  // namespace hmlfc::vectors
