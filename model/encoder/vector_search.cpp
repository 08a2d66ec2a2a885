#include "encoder/vector_search.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "encoder/error_kernels.hpp"

namespace hmlfc {

VectorSearch::VectorSearch(const MotionTask& task, const std::vector<PaletteEntry>& symbols)
    : task_(task),
      estimate_(task.lambda, shift_of(task.lambda)),
      bound_(reference_bound(Plane::kY, task.sources.header.depth, true)) {
  for (const PaletteEntry& symbol : symbols) {
    const bool one = references_of_set(symbol.reference_set).count == 1;
    if (one && symbol.choice == kChoiceOwn) sets_.push_back(symbol.reference_set);
  }
}

std::vector<PaletteEntry> VectorSearch::run(const Area& area, int64_t most) {
  std::vector<PaletteEntry> found;
  for (const uint8_t set : sets_) {
    const size_t k = references_of_set(set).reference[0];
    MotionVector vector = start(area, k);
    if (descend(area, k, vector) >= most) continue;
    found.push_back({set, kChoiceVector, false, static_cast<int16_t>(vector.x),
                     static_cast<int16_t>(vector.y)});
  }
  return found;
}

MotionVector VectorSearch::start(const Area& area, size_t k) const {
  const MotionSources& sources = task_.sources;
  const unsigned grid_log2 = sources.header.disparity_grid_log2;
  const int32_t d = sources.grid.at(static_cast<uint32_t>(area.x + area.width / 2) >> grid_log2,
                                    static_cast<uint32_t>(area.y + area.height / 2) >> grid_log2);
  return sources.full_vector(k, d);
}

// What `vector` into Kk leaves of `area`; at least `most` if it is not less than that.
int64_t VectorSearch::left(const Area& area, size_t k, const MotionVector& vector, int64_t most) {
  const auto columns = static_cast<unsigned>(area.width);
  const auto rows = static_cast<unsigned>(area.height);
  const SubpelVector moved = subpel_vector(vector, task_.sources.header.vector_precision, false);
  int64_t sum = 0;
  for (unsigned y = 0; y < rows && sum < most; y += 4) {
    const int32_t top = area.y + static_cast<int32_t>(y);
    const unsigned height = std::min(4u, rows - y);
    interpolate_rect({displaced(*task_.references[k], area.x, top, moved)}, 1, bound_,
                     {predicted_.data(), kSide, columns, height});
    const int16_t* target = task_.target.row(static_cast<uint32_t>(top)).data() + area.x;
    square_errors({target, task_.target.width, kSide, columns, height}, predicted_.data(),
                  squares_.data());
    for (unsigned i = 0; i < ceil_div(columns, 4u); ++i) sum += estimate_(squares_[i]);
  }
  return sum;
}

// Moves `vector` to where each move leaves more, in ever smaller steps from one sample on. Returns
// what it leaves.
int64_t VectorSearch::descend(const Area& area, size_t k, MotionVector& vector) {
  int64_t least = left(area, k, vector, INT64_MAX);
  for (int32_t step = 1 << task_.sources.header.vector_precision; step > 0; step /= 2) {
    const std::array<MotionVector, 4> moves{{{step, 0}, {-step, 0}, {0, step}, {0, -step}}};
    MotionVector before = vector;
    size_t failed = 0;  // moves in a row that leave no less
    for (size_t i = 0; failed < moves.size(); ++i) {
      const MotionVector& move = moves[i % moves.size()];
      const MotionVector next =
          bounded_vector(vector.x + move.x, vector.y + move.y, task_.sources.rules);
      ++failed;
      if (next == before) continue;
      const int64_t sum = left(area, k, next, least);
      if (sum >= least) continue;
      least = sum;
      before = std::exchange(vector, next);
      failed = 0;
    }
  }
  return least;
}

}  // namespace hmlfc
