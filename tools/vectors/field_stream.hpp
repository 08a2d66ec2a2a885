// Whole streams field by field, each by a rule or at random; no encoder decides any.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/format.hpp>

#include "decoder/jpeg2000.hpp"
#include "syntax/index.hpp"
#include "vectors/field_rules.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// The rules for a stream.
struct StreamRules {
  StreamHeader header;  ///< has passed check_fields; its section table is not used
  IndexLayout index;
  FieldRules fields;             ///< of images that are no reference images
  FieldRules reference_fields;   ///< of reference images and key images
  double key_error = 0;          ///< with lossy_keys: about the mean squared error of key images
  CodestreamOptions key_coding;  ///< of key images
  std::vector<uint8_t> rig;      ///< section RIG, with camera_rig
};

/// The stream that `rules` give with the numbers of `seed`.
std::vector<uint8_t> field_stream(StreamRules rules, uint64_t seed);

/// The stream of a recipe: {"header": {...}, "index": {...}, "fields": {...}, "reference": {...},
/// "key_error": e, "key_coding": {...}, "rig": text}, key_coding as in key_coding.hpp. "reference"
/// has the rules of reference images that differ from "fields". Throws TextError.
std::vector<uint8_t> field_stream(const Json& json, uint64_t seed);

/// Limits of random streams; each number is an inclusive maximum.
struct Limits {
  uint32_t grid_side = 5;    ///< rows and cols, each, [1, 4096]
  uint32_t view_side = 70;   ///< width and height, each, [1, 65536]
  int depth = 12;            ///< [8, 12]
  int window = 127;          ///< [0, 127]
  int tree_height = 3;       ///< [0, 15]
  bool main = true;          ///< whether streams may be of profile main
  bool extended = true;      ///< whether streams may be of profile extended
  unsigned block_sizes = 7;  ///< bit i: blocks of 2 << i may occur, not 0
  bool rig = true;           ///< whether streams of profile extended may have camera_rig
};

/// The limits that a recipe names, with defaults for the others.
Limits limits_from(const Json& json);

/// A valid stream: both profiles, any features that fit together, block sizes, formats, depths,
/// grids, reference groups, and every field over its whole interval. The same bytes for the same
/// arguments on every machine. All blocks decode. Throws std::bad_alloc.
std::vector<uint8_t> random_stream(uint64_t seed, const Limits& limits);

}  // namespace hmlfc::vectors
