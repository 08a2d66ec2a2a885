// The best streams of a search: for each end of each interval of the specification's width table
// the one that came closest.
#pragma once

#include <cstdint>
#include <vector>

#include "vectors/json.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {

using vectors::Json;

/// One end of the interval of one place of the width table.
struct Target {
  Place place;
  bool upper = false;

  /// How far a stream that reached `reached` stayed from the end; INT64_MAX where the quantity did
  /// not occur.
  int64_t distance(const Reached& reached) const;
};

/// The ends that streams can be driven to: all but the lower end of a quantity that is one value.
std::vector<Target> targets();

/// The recipe that came closest to a target.
struct Best {
  int64_t distance = INT64_MAX;
  uint64_t bytes = 0;  ///< of its stream: of two recipes as close the smaller one is kept
  Json recipe;
  Ranges ranges;  ///< what its stream reached
};

class Archive {
 public:
  Archive() : targets_(targets()), best_(targets_.size()) {}

  /// Takes in what the stream of `recipe` reached. True if it is closer to any target than all
  /// before.
  bool add(const Json& recipe, uint64_t bytes, const Ranges& ranges);

  size_t size() const { return targets_.size(); }
  const Target& target(size_t i) const { return targets_[i]; }
  const Best& best(size_t i) const { return best_[i]; }

  /// Targets whose end is not reached.
  std::vector<size_t> open() const;

  /// A few recipes that together reach every end that any recipe reached, and come as close to the
  /// others.
  std::vector<Json> cover() const;

 private:
  std::vector<Target> targets_;
  std::vector<Best> best_;
};

}  // namespace hmlfc::stress
