#include "encoder/subpel_prediction.hpp"

#include <algorithm>

namespace hmlfc {
namespace {

// The reference sets worth trying: those without an image that also has a lower number.
std::vector<uint8_t> reference_sets(const MotionSources& sources) {
  if (!sources.two_references()) return {0};
  const auto repeated = [&](size_t k) {
    const auto end = sources.places.begin() + static_cast<ptrdiff_t>(k);
    return std::find(sources.places.begin(), end, sources.places[k]) != end;
  };
  std::vector<uint8_t> sets;
  for (uint8_t set = 0; set < 8; ++set) {
    const ReferenceSet refs = references_of_set(set);
    if (repeated(refs.reference[0]) || (refs.count == 2 && repeated(refs.reference[1]))) continue;
    sets.push_back(set);
  }
  return sets;
}

}  // namespace

std::vector<PaletteEntry> candidate_symbols(const MotionSources& sources, unsigned choices) {
  std::vector<PaletteEntry> symbols{sources.default_symbol()};
  for (unsigned choice = 1; choice <= choices; ++choice) {
    for (const uint8_t set : reference_sets(sources)) {
      const PaletteEntry plus{set, static_cast<uint8_t>(choice)};
      if (plus != symbols.front()) symbols.push_back(plus);
      if (sources.keyed) continue;
      PaletteEntry minus = plus;
      minus.negative = true;
      symbols.push_back(minus);
    }
  }
  return symbols;
}

void interpolate(const PaddedPlane& reference, const Area& area, const SubpelVector& vector,
                 int32_t* out) {
  const ptrdiff_t stride = reference.stride();
  const int16_t* row = reference.at(area.x + vector.ix, area.y + vector.iy);
  const int32_t right = vector.fx;
  const int32_t left = 8 - right;
  const int32_t below = vector.fy;
  const int32_t above = 8 - below;
  for (int32_t j = 0; j < area.height; ++j, row += stride, out += area.width) {
    const int16_t* next = row + stride;
    if (right == 0 && below == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 64 * row[i];
    } else if (below == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 8 * (left * row[i] + right * row[i + 1]);
    } else if (right == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 8 * (above * row[i] + below * next[i]);
    } else {
      for (int32_t i = 0; i < area.width; ++i) {
        out[i] = above * (left * row[i] + right * row[i + 1]) +
                 below * (left * next[i] + right * next[i + 1]);
      }
    }
  }
}

void combine(const int32_t* first, const int32_t* second, int32_t samples, int32_t* out) {
  if (second == nullptr) {
    for (int32_t i = 0; i < samples; ++i) out[i] = (first[i] + 32) >> 6;
  } else {
    for (int32_t i = 0; i < samples; ++i) out[i] = (first[i] + second[i] + 64) >> 7;
  }
}

}  // namespace hmlfc
