#include "archive.hpp"

namespace hmlfc::stress {

int64_t Target::distance(const Reached& reached) const {
  if (!reached.any()) return INT64_MAX;
  const WidthInterval limits = limits_of(place);
  return upper ? limits.hi - reached.greatest : reached.least - limits.lo;
}

std::vector<Target> targets() {
  std::vector<Target> all;
  for (const Place& place : places(WidthTable::kStreams)) {
    if (!kWidthRows[place.row].one_value) all.push_back({place, false});
    all.push_back({place, true});
  }
  return all;
}

bool Archive::add(const Json& recipe, uint64_t bytes, const Ranges& ranges) {
  bool closer = false;
  for (size_t i = 0; i < targets_.size(); ++i) {
    const int64_t distance = targets_[i].distance(ranges.at(targets_[i].place));
    Best& best = best_[i];
    if (distance == INT64_MAX || distance > best.distance) continue;
    if (distance == best.distance && bytes >= best.bytes) continue;
    closer = closer || distance < best.distance;
    best = {distance, bytes, recipe, ranges};
  }
  return closer;
}

std::vector<size_t> Archive::open() const {
  std::vector<size_t> indices;
  for (size_t i = 0; i < targets_.size(); ++i) {
    if (best_[i].distance != 0) indices.push_back(i);
  }
  return indices;
}

// Each in turn the recipe that serves most of the targets that none before it serves.
std::vector<Json> Archive::cover() const {
  std::vector<Json> recipes;
  std::vector<bool> served(targets_.size());
  const auto serves = [&](const Best& best, size_t i) {
    return !served[i] && best_[i].distance != INT64_MAX &&
           targets_[i].distance(best.ranges.at(targets_[i].place)) == best_[i].distance;
  };
  while (true) {
    const Best* most = nullptr;
    size_t most_served = 0;
    for (const Best& best : best_) {
      size_t count = 0;
      for (size_t i = 0; i < targets_.size(); ++i) count += serves(best, i) ? 1u : 0u;
      if (count > most_served) {
        most = &best;
        most_served = count;
      }
    }
    if (most == nullptr) return recipes;
    recipes.push_back(most->recipe);
    for (size_t i = 0; i < targets_.size(); ++i) served[i] = served[i] || serves(*most, i);
  }
}

}  // namespace hmlfc::stress
