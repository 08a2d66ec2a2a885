// Recipes of streams (vectors/field_stream.hpp) and small changes to them.
#pragma once

#include "vectors/json.hpp"
#include "vectors/random.hpp"

namespace hmlfc::stress {

/// A recipe to begin with: a few small views in profile extended with all tools of motion, every
/// field uniform in its interval.
vectors::Json first_recipe(vectors::Random& random);

/// `recipe` with some of its header fields and rules changed. It need not be valid: field_stream
/// throws TextError for those that are not.
vectors::Json mutated(vectors::Json recipe, vectors::Random& random);

}  // namespace hmlfc::stress
