#include "encoder/predicted_plane.hpp"

#include <algorithm>

#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {
namespace {

using Samples = std::array<int32_t, size_t{kMaxBlockSize} * kMaxBlockSize>;

class PlanePredictor {
 public:
  explicit PlanePredictor(const PredictionTask& task)
      : task_(task),
        shape_(task.geometry->plane(task.plane)),
        motion_(task.geometry->motion_planes()[task.geometry->motion_plane_of(task.plane)]),
        halved_(task.plane != Plane::kY && motion_.halves),
        size_(static_cast<int32_t>(task.geometry->block_size())),
        range_(sample_range(task.plane, task.depth)) {}

  SamplePlane run() const {
    const auto size = static_cast<uint32_t>(size_);
    SamplePlane plane(shape_.blocks_x * size, shape_.blocks_y * size);
    for (uint32_t by = 0; by < shape_.blocks_y; ++by) {
      for (uint32_t bx = 0; bx < shape_.blocks_x; ++bx) predict(bx, by, plane);
    }
    return plane;
  }

 private:
  // The palette entry of the block at place (x, y) of the motion plane (MOT-4).
  const PaletteEntry& symbol_at(uint32_t x, uint32_t y) const {
    const uint32_t tx = x >> task_.tile_log2;
    const uint32_t ty = y >> task_.tile_log2;
    const MotionTileCode& tile = task_.tiles[size_t{ty} * motion_.tiles_x + tx];
    if (tile.empty) return task_.default_symbol;
    const uint32_t mask = (1u << task_.tile_log2) - 1;
    const uint32_t inside = std::min(mask + 1, motion_.width - (tx << task_.tile_log2));
    const uint32_t columns = ceil_div(inside, 1u << tile.block_log2);
    const uint32_t index =
        ((y & mask) >> tile.block_log2) * columns + ((x & mask) >> tile.block_log2);
    return tile.palette[tile.indices[index]];
  }

  int32_t disparity_at(uint32_t x, uint32_t y, const PaletteEntry& symbol) const {
    if (symbol.choice == kChoiceDisparity) return symbol.explicit_x;
    const auto& move = kChoiceMoves[symbol.choice];
    const DisparityGrid& grid = *task_.grid;
    const int32_t gx = clamp(static_cast<int32_t>(x >> task_.grid_log2) + move[0], 0,
                             static_cast<int32_t>(grid.blocks_x) - 1);
    const int32_t gy = clamp(static_cast<int32_t>(y >> task_.grid_log2) + move[1], 0,
                             static_cast<int32_t>(grid.blocks_y) - 1);
    return grid.at(static_cast<uint32_t>(gx), static_cast<uint32_t>(gy));
  }

  void predict(uint32_t bx, uint32_t by, SamplePlane& plane) const {
    const auto size = static_cast<uint32_t>(size_);
    const uint32_t scale = halved_ ? 2 : 1;
    const uint32_t x = bx * size * scale;
    const uint32_t y = by * size * scale;
    const PaletteEntry& symbol = symbol_at(x, y);
    Samples reference{};
    if (symbol.choice != kChoiceNone) {
      const Area area{static_cast<int32_t>(bx * size), static_cast<int32_t>(by * size), size_,
                      size_};
      read_references(symbol, disparity_at(x, y, symbol), area, reference);
    }
    for (uint32_t j = 0; j < size; ++j) {
      const auto out = plane.row(by * size + j);
      for (uint32_t i = 0; i < size; ++i) {
        const uint32_t column = bx * size + i;
        const int32_t parent =
            task_.parent == nullptr ? 0 : task_.parent->at(column, by * size + j);
        const int32_t base = task_.keyed && symbol.choice != kChoiceNone ? 0 : parent;
        const int32_t value =
            symbol.choice == kChoiceNone
                ? base
                : motion_prediction(base, symbol.negative, reference[j * size + i], range_);
        out[column] = static_cast<int16_t>(value);
      }
    }
  }

  void read_references(const PaletteEntry& symbol, int32_t d, const Area& area,
                       Samples& out) const {
    const ReferenceSet refs = references_of_set(symbol.reference_set);
    Samples parts[2];
    for (size_t k = 0; k < refs.count; ++k) fetch(refs.reference[k], d, area, parts[k]);
    combine(parts[0].data(), refs.count == 2 ? parts[1].data() : nullptr, area.samples(),
            out.data());
  }

  void fetch(size_t k, int32_t d, const Area& area, Samples& out) const {
    const ImagePos place = task_.places[k];
    const MotionVector v = disparity_vector(
        d, static_cast<int32_t>(place.row) - static_cast<int32_t>(task_.at.row),
        static_cast<int32_t>(place.col) - static_cast<int32_t>(task_.at.col), task_.rules);
    interpolate(*task_.references[k], area, subpel_vector(v, task_.vector_precision, halved_),
                out.data());
  }

  const PredictionTask& task_;
  const PlaneShape& shape_;
  const MotionPlaneShape& motion_;
  bool halved_;
  int32_t size_;
  SampleRange range_;
};

}  // namespace

SamplePlane predict_plane(const PredictionTask& task) { return PlanePredictor(task).run(); }

}  // namespace hmlfc
