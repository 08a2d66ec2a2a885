// Which images an encoding works on: all, those of a trial, or those that a range of views takes,
// so that a light field can be encoded part by part, in any order and on many machines.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// The images of one level, each list row by row.
struct LevelPart {
  std::vector<ImagePos> references;  ///< to code, also those that other parts code, too
  std::vector<bool> known;           ///< of references: key images that a part before has coded
  std::vector<ImagePos> predictive;  ///< likewise to code
  std::vector<ImagePos> groups;      ///< references whose group's shared decisions are needed
  std::vector<ImagePos> context;     ///< key images that are looked at and not coded
  std::vector<ImagePos> originals;   ///< all whose original is looked at; empty at level 0
  bool predicts = false;             ///< the level has predictive images, here or in other parts
};

struct EncodePart {
  std::vector<LevelPart> levels;  ///< from level 0 on
  /// The views that it is. None: a trial, which gives no stream, and whose error is not measured.
  std::optional<ImageRange> views;
};

/// Whether image `at` of level `level` belongs to `views`: the first view below it does. Each image
/// belongs to one of the ranges that make up a grid.
bool owns(const ImageRange& views, const Geometry& geometry, int level, ImagePos at);

/// Takes of level 0 only the images `sample`, which are predictive, and what they refer to; one
/// reference image if there are none. The tree has one level.
EncodePart sampled_part(const Geometry& geometry, const std::vector<ImagePos>& sample);

/// The images that belong to `views`, and all that coding them depends on. `known`: whether a key
/// image of a level has been coded before.
EncodePart part_of_views(const Geometry& geometry, const ImageRange& views,
                         const std::function<bool(int level, ImagePos at)>& known);

/// All predictive images of the group of `reference`, row by row.
std::vector<ImagePos> members_of(const Geometry& geometry, int level, ImagePos reference);

/// At most `count` > 0 of `images`, which lie row by row in a rectangle, evenly spread over it.
std::vector<ImagePos> spread_images(std::vector<ImagePos> images, size_t count);

/// How far predictive view `at` is from its first two references, of which the first counts most.
int32_t distance_from_references(const Geometry& geometry, ImagePos at);

}  // namespace hmlfc
