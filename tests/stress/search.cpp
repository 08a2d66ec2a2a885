#include "search.hpp"

#include <chrono>

#include "mutate_recipe.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/random.hpp"

namespace hmlfc::stress {
namespace {

using vectors::Random;

// Throws vectors::TextError for a recipe that is not valid.
std::vector<uint8_t> stream_of(Json recipe) {
  const uint64_t seed = recipe.value("seed", uint64_t{1});
  recipe.erase("seed");
  return vectors::field_stream(recipe, seed);
}

class Climb {
 public:
  Climb(Session& session, uint64_t seed) : session_(session), random_(seed) {}

  void try_recipe(const Json& recipe) {
    std::vector<uint8_t> bytes;
    try {
      bytes = stream_of(recipe);
    } catch (const vectors::TextError&) {
      return;
    }
    ++streams_;
    archive_.add(recipe, bytes.size(), session_.run("search " + recipe.dump(), bytes));
  }

  void step() {
    const std::vector<size_t> open = archive_.open();
    const size_t target = open[random_.below(open.size())];
    Json parent = parent_of(target);
    try_recipe(parent.is_null() ? first_recipe(random_) : mutated(std::move(parent), random_));
  }

  bool done() const { return archive_.open().empty(); }
  uint64_t streams() const { return streams_; }
  Archive& archive() { return archive_; }

 private:
  // The closest recipe of `target`; sometimes that of another end, plane or depth of the same
  // quantity at the target's depth, sometimes any.
  Json parent_of(size_t target) {
    const Place& place = archive_.target(target).place;
    const unsigned kind = random_.below(8);
    if (kind == 0) return archive_.best(random_.below(archive_.size())).recipe;
    if (kind > 2) return archive_.best(target).recipe;
    std::vector<size_t> same_row;
    for (size_t i = 0; i < archive_.size(); ++i) {
      if (archive_.target(i).place.row == place.row) same_row.push_back(i);
    }
    Json recipe = archive_.best(same_row[random_.below(same_row.size())]).recipe;
    if (!recipe.is_null() && kWidthRows[place.row].by_depth) {
      recipe["header"]["depth"] = place.depth + kMinDepth;
    }
    return recipe;
  }

  Session& session_;
  Random random_;
  Archive archive_;
  uint64_t streams_ = 0;
};

}  // namespace

int64_t Target::distance(const Reached& reached) const {
  if (!reached.any()) return INT64_MAX;
  const WidthInterval limits = limits_of(place);
  return upper ? limits.hi - reached.max : reached.min - limits.lo;
}

Archive::Archive() {
  for (const Place& place : places(WidthTable::kStreams)) {
    if (!kWidthRows[place.row].one_value) targets_.push_back({place, false});
    targets_.push_back({place, true});
  }
  best_.resize(targets_.size());
}

void Archive::add(const Json& recipe, uint64_t bytes, const Ranges& ranges) {
  for (size_t i = 0; i < targets_.size(); ++i) {
    const int64_t distance = targets_[i].distance(ranges.at(targets_[i].place));
    Best& best = best_[i];
    if (distance == INT64_MAX || distance > best.distance) continue;
    if (distance == best.distance && bytes >= best.bytes) continue;
    best = {distance, bytes, recipe, ranges};
  }
}

std::vector<size_t> Archive::open() const {
  std::vector<size_t> indices;
  for (size_t i = 0; i < targets_.size(); ++i) {
    if (best_[i].distance != 0) indices.push_back(i);
  }
  return indices;
}

// Greedy: always the recipe that serves most of the targets not yet served.
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

Archive search(Session& session, uint64_t seed, double seconds, uint64_t max_streams,
               const std::vector<Json>& begin) {
  const auto started = std::chrono::steady_clock::now();
  Climb climb(session, seed);
  for (const Json& recipe : begin) climb.try_recipe(recipe);
  while (!climb.done() && climb.streams() < max_streams) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
    if (elapsed.count() >= seconds) break;
    climb.step();
  }
  return climb.archive();
}

}  // namespace hmlfc::stress
