#include "vectors/base_vector.hpp"

#include <algorithm>
#include <tuple>

namespace hmlfc::vectors {
namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

// How many words of `words` are not among `others`.
auto missing(const std::vector<std::string>& words, const std::vector<std::string>& others) {
  return std::ranges::count_if(words, [&](const std::string& word) { return !has(others, word); });
}

}  // namespace

VectorId base_of(const Vector& refused, const Recipes& recipes, const std::vector<Vector>& all) {
  const Recipe* recipe = &recipes.at(refused.id.text());
  while (recipe->stream.value("kind", "") == "edit") {
    recipe = &recipes.at(recipe->stream.at("base").get<std::string>());
    if (recipe->expect.outcome == Outcome::kOk && recipe->listed) return VectorId(recipe->id);
  }
  const auto distance = [&](const Vector& vector) {
    return std::tuple(missing(refused.flags, vector.flags),
                      missing(refused.clauses, vector.clauses),
                      missing(vector.flags, refused.flags), vector.input.bytes);
  };
  const Vector* best = nullptr;
  for (const Vector& vector : all) {
    if (vector.expect.outcome != Outcome::kOk || vector.profile != refused.profile ||
        vector.level > refused.level) {
      continue;
    }
    if (best == nullptr || distance(vector) < distance(*best)) best = &vector;
  }
  if (best == nullptr) throw TextError(refused.id.text() + ": no vector can be its base");
  return best->id;
}

}  // namespace hmlfc::vectors
