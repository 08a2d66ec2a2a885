// Drives every quantity of the specification's width table towards both ends of its interval.
#pragma once

#include <cstdint>
#include <vector>

#include "session.hpp"
#include "vectors/json.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {

using vectors::Json;

/// One end of the interval of one place of the width table.
struct Target {
  Place place;
  bool upper = false;

  /// Distance of what a stream reached from the end; INT64_MAX where the quantity did not occur.
  int64_t distance(const Reached& reached) const;
};

/// The recipe that came closest to a target.
struct Best {
  int64_t distance = INT64_MAX;
  uint64_t bytes = 0;  ///< of its stream: of two equally close recipes the smaller is kept
  Json recipe;
  Ranges ranges;  ///< what its stream reached
};

/// The best recipe for each target: all ends except the lower end of a quantity that is one value.
class Archive {
 public:
  Archive();

  /// Takes in what the stream of `recipe` reached.
  void add(const Json& recipe, uint64_t bytes, const Ranges& ranges);

  size_t size() const { return targets_.size(); }
  const Target& target(size_t i) const { return targets_[i]; }
  const Best& best(size_t i) const { return best_[i]; }

  /// Targets whose end is not reached.
  std::vector<size_t> open() const;

  /// A few recipes that together come as close to every target as the best ones.
  std::vector<Json> cover() const;

 private:
  std::vector<Target> targets_;
  std::vector<Best> best_;
};

/// Hill climbing over recipes, each {"comment": text, "header": ..., "fields": ..., "reference":
/// ..., "seed": n} as in vectors/field_stream.hpp. Of an open target, changes the closest recipe,
/// or that of another depth of the same quantity; keeps what comes closer to any target. Ends after
/// `seconds` or `max_streams`, or when all ends are reached. The same streams for the same seed,
/// `begin` and number of streams.
Archive search(Session& session, uint64_t seed, double seconds, uint64_t max_streams,
               const std::vector<Json>& begin);

}  // namespace hmlfc::stress
