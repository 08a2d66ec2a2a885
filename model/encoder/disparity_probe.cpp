#include <algorithm>
#include <cstdlib>

#include "encoder/disparity_search.hpp"
#include "encoder/motion_prediction.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

// The largest disparity that is looked for, in samples per view.
constexpr int32_t kMaxDisparityPerView = 12;
constexpr unsigned kProbeGridLog2 = 4;

class DisparityProbe {
 public:
  DisparityProbe(const LightField& light_field, const StreamHeader& header)
      : light_field_(light_field), header_(header), geometry_(header) {
    const LevelShape& level = geometry_.level(0);
    reference_ = geometry_.reference_of(0, {level.rows / 2, level.cols / 2});
    for (uint32_t r = 0; r < level.rows; ++r) {
      for (uint32_t c = 0; c < level.cols; ++c) add_member({r, c});
    }
  }

  CoarseResult search(int row_scale) const {
    const PaddedPlane reference(luma(reference_), header_.width, header_.height,
                                header_.window + 10);
    StreamHeader header = header_;
    header.row_scale = row_scale;
    DisparitySearch search = disparity_search(header);
    search.reference = &reference;
    search.targets = targets_;
    for (size_t i = 0; i < planes_.size(); ++i) search.targets[i].plane = &planes_[i];
    search.grid_log2 = kProbeGridLog2;
    const int32_t limit = std::min(kMaxDisparityPerView, std::max(1, header_.window / farthest_));
    return coarse_disparities(search, limit << header_.disparity_precision);
  }

 private:
  SamplePlane luma(ImagePos at) const { return view_planes(light_field_, geometry_, at)[0]; }

  void add_member(ImagePos at) {
    if (at == reference_ || geometry_.reference_of(0, at) != reference_) return;
    const int32_t rows = row_offset(reference_, at);
    const int32_t cols = col_offset(reference_, at);
    farthest_ = std::max({farthest_, std::abs(rows), std::abs(cols)});
    targets_.push_back({nullptr, rows, cols});
    planes_.push_back(luma(at));
  }

  const LightField& light_field_;
  const StreamHeader& header_;
  Geometry geometry_;
  ImagePos reference_;
  std::vector<SearchTarget> targets_;
  std::vector<SamplePlane> planes_;
  int32_t farthest_ = 1;
};

}  // namespace

FieldDisparity probe_disparities(const LightField& light_field, const StreamHeader& header) {
  const DisparityProbe probe(light_field, header);
  const CoarseResult down = probe.search(16);
  FieldDisparity found{down.range, 16};
  if (header.rows == 1) return found;
  const CoarseResult up = probe.search(-16);
  if (up.error < down.error) found = {up.range, -16};
  return found;
}

}  // namespace hmlfc
