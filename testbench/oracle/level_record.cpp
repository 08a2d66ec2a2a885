#include "oracle/level_record.hpp"

#include <initializer_list>
#include <tuple>

namespace hmlfc::tb {
namespace {

// A field: its name, what was expected and what came.
using Field = std::tuple<std::string, int64_t, int64_t>;

std::optional<Difference> first_of(const char* stage, std::initializer_list<Field> fields) {
  for (const auto& [name, expected, actual] : fields) {
    if (expected != actual) return Difference{stage, name, expected, actual};
  }
  return std::nullopt;
}

std::optional<Difference> first_of_vectors(const LevelRecord& e, const LevelRecord& a) {
  if (auto d = first_of("vector", {{"sign -", e.negative, a.negative},
                                   {"references", e.references, a.references}})) {
    return d;
  }
  for (unsigned i = 0; i < e.references; ++i) {
    const SubpelVector& v = e.vectors[i];
    const SubpelVector& w = a.vectors[i];
    const std::string of = " of reference " + std::to_string(i);
    if (auto d = first_of("vector", {{"ix" + of, v.ix, w.ix},
                                     {"iy" + of, v.iy, w.iy},
                                     {"fx" + of, v.fx, w.fx},
                                     {"fy" + of, v.fy, w.fy}})) {
      return d;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Difference> first_difference(const int16_t* expected, const int16_t* actual,
                                           const char* stage, unsigned block_size,
                                           unsigned inside_x, unsigned inside_y) {
  for (unsigned y = 0; y < inside_y; ++y) {
    for (unsigned x = 0; x < inside_x; ++x) {
      const size_t i = size_t{y} * block_size + x;
      if (expected[i] == actual[i]) continue;
      return Difference{stage, "sample (" + std::to_string(x) + ", " + std::to_string(y) + ")",
                        expected[i], actual[i]};
    }
  }
  return std::nullopt;
}

std::optional<Difference> first_difference(const LevelRecord& expected, const LevelRecord& actual,
                                           unsigned block_size, unsigned inside_x,
                                           unsigned inside_y) {
  if (auto d = first_of("error", {{"error", expected.error, actual.error}})) return d;
  if (expected.error != 0) return std::nullopt;
  if (auto d =
          first_of("index entry", {{"key image", expected.key, actual.key},
                                   {"motion", expected.motion, actual.motion},
                                   {"has residual", expected.has_residual, actual.has_residual}})) {
    return d;
  }
  const auto values = [&](const StageValues& e, const StageValues& a, const char* stage) {
    return first_difference(e.data(), a.data(), stage, block_size, inside_x, inside_y);
  };
  if (!expected.key) {
    if (expected.motion) {
      if (auto d = first_of_vectors(expected, actual)) return d;
    }
    if (expected.has_residual) {
      if (auto d = values(expected.residual, actual.residual, "residual")) return d;
    }
    if (expected.motion) {
      if (auto d = values(expected.reference, actual.reference, "reference")) return d;
    }
    if (auto d = values(expected.prediction, actual.prediction, "prediction")) return d;
  }
  return values(expected.sample, actual.sample, "sample");
}

std::string to_string(const BlockSite& site) {
  return "level " + std::to_string(site.level) + " image " + std::to_string(site.image_row) + "," +
         std::to_string(site.image_col) + " plane " + std::string(plane_name(site.plane)) +
         " block " + std::to_string(site.bx) + "," + std::to_string(site.by);
}

}  // namespace hmlfc::tb
