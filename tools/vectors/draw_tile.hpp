// The fields of one tile record by the rules of a recipe.
#pragma once

#include <optional>

#include "syntax/tile_record.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// The fields of a tile of `context`; none where it is empty. With rules that keep to intervals
/// (those without numbers do) the record is valid.
std::optional<TileFields> draw_tile(FieldRules& rules, const TileContext& context, Random& random);

}  // namespace hmlfc::vectors
