#include "search.hpp"

#include <chrono>
#include <new>

#include "mutate_recipe.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/random.hpp"

namespace hmlfc::stress {
namespace {

using vectors::Random;

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
  // The closest recipe of `target`; at times that of another end, plane or depth of the same
  // quantity at the target's depth, at times any.
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
      recipe["header"]["depth"] = place.depth + kLeastDepth;
    }
    return recipe;
  }

  Session& session_;
  Random random_;
  Archive archive_;
  uint64_t streams_ = 0;
};

}  // namespace

std::vector<uint8_t> stream_of(const Json& recipe) {
  Json rules = recipe;
  rules.erase("seed");
  return vectors::field_stream(rules, recipe.value("seed", uint64_t{1}));
}

Archive search(Session& session, uint64_t seed, double seconds, uint64_t most_streams,
               const std::vector<Json>& begin) {
  const auto started = std::chrono::steady_clock::now();
  Climb climb(session, seed);
  for (const Json& recipe : begin) climb.try_recipe(recipe);
  while (!climb.done() && climb.streams() < most_streams) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
    if (elapsed.count() >= seconds) break;
    climb.step();
  }
  return climb.archive();
}

}  // namespace hmlfc::stress
