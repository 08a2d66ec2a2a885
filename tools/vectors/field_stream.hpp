// Whole streams field by field: every symbol by a rule, none by an encoder's choice.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/format.hpp>

#include "syntax/index.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// What a stream is made of.
struct StreamRules {
  StreamHeader header;  ///< has passed check_fields; its section table is not used
  IndexLayout index;
  FieldRules fields;            ///< of images that are no reference images
  FieldRules reference_fields;  ///< of reference images and key images
  double key_error = 0;         ///< with lossy_keys: about the mean squared error of key images
};

/// The stream that `rules` give with the numbers of `seed`.
std::vector<uint8_t> field_stream(StreamRules rules, uint64_t seed);

/// The stream of a recipe: {"header": {...}, "index": {...}, "fields": {...}, "reference": {...},
/// "key_error": e}. "reference" has the rules of reference images that differ from "fields".
/// Throws TextError.
std::vector<uint8_t> field_stream(const Json& json, uint64_t seed);

}  // namespace hmlfc::vectors
