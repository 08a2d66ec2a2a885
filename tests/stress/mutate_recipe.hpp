// Recipes of streams (vectors/field_stream.hpp) and small changes to them.
#pragma once

#include "vectors/json.hpp"
#include "vectors/random.hpp"

namespace hmlfc::stress {

/// A recipe to begin with: a few small views in profile extended with random features, every field
/// uniform in its interval.
vectors::Json first_recipe(vectors::Random& random);

/// `recipe` with one to four changes to its header, rules or seed. The result need not be valid:
/// field_stream then throws TextError.
vectors::Json mutated(vectors::Json recipe, vectors::Random& random);

}  // namespace hmlfc::stress
