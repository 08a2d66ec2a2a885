#include "oracle/level_record.hpp"

namespace hmlfc::tb {
namespace {

class RecordComparison {
 public:
  RecordComparison(const LevelRecord& expected, const LevelRecord& actual)
      : expected_(expected), actual_(actual) {}

  std::optional<Difference> entry() const {
    if (auto d = field("error", "error", expected_.error, actual_.error)) return d;
    if (expected_.error != 0) return std::nullopt;
    if (auto d = field("index entry", "key image", expected_.key, actual_.key)) return d;
    if (auto d = field("index entry", "motion", expected_.motion, actual_.motion)) return d;
    return field("index entry", "has residual", expected_.has_residual, actual_.has_residual);
  }

  std::optional<Difference> vectors() const {
    if (!expected_.motion) return std::nullopt;
    if (auto d = field("vector", "sign -", expected_.negative, actual_.negative)) return d;
    if (auto d = field("vector", "references", expected_.references, actual_.references)) return d;
    for (unsigned i = 0; i < expected_.references; ++i) {
      const SubpelVector& e = expected_.vectors[i];
      const SubpelVector& a = actual_.vectors[i];
      const std::string of = " of reference " + std::to_string(i);
      if (auto d = field("vector", "ix" + of, e.ix, a.ix)) return d;
      if (auto d = field("vector", "iy" + of, e.iy, a.iy)) return d;
      if (auto d = field("vector", "fx" + of, e.fx, a.fx)) return d;
      if (auto d = field("vector", "fy" + of, e.fy, a.fy)) return d;
    }
    return std::nullopt;
  }

 private:
  static std::optional<Difference> field(const char* stage, const std::string& name,
                                         int64_t expected, int64_t actual) {
    if (expected == actual) return std::nullopt;
    return Difference{stage, name, expected, actual};
  }

  const LevelRecord& expected_;
  const LevelRecord& actual_;
};

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
  const RecordComparison compare(expected, actual);
  if (auto d = compare.entry()) return d;
  if (expected.error != 0) return std::nullopt;
  const auto values = [&](const StageValues& e, const StageValues& a, const char* stage) {
    return first_difference(e.data(), a.data(), stage, block_size, inside_x, inside_y);
  };
  if (!expected.key) {
    if (auto d = compare.vectors()) return d;
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
