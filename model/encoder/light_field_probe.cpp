#include "encoder/light_field_probe.hpp"

#include <algorithm>
#include <cstdlib>

#include "bits/parallel.hpp"
#include "encoder/key_refinement.hpp"
#include "encoder/motion_prediction.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

// The largest disparity that is looked for, in samples per view.
constexpr int32_t kMaxDisparityPerView = 12;
// The views looked at: so many rows and columns away from the middle, where the grid has them.
constexpr int32_t kReach = 2;
constexpr unsigned kProbeGridLog2 = 4;
// A lambda with which no residual ever pays: squared errors count as they are.
constexpr int64_t kNoResidual = int64_t{1} << 40;
// The lambda of quality 60, and the images of a group of 5x5: what a key image costs hardly depends
// on either.
constexpr Lambda kUsualLambda{int64_t{256} << 5};
constexpr size_t kUsualImages = 24;

ImagePos middle_of(const LightFieldShape& shape) { return {shape.rows / 2, shape.cols / 2}; }

ImagePos moved(ImagePos at, int32_t rows, int32_t cols) {
  return {static_cast<uint32_t>(static_cast<int32_t>(at.row) + rows),
          static_cast<uint32_t>(static_cast<int32_t>(at.col) + cols)};
}

// Moves along a line of `count` views from the one in its middle.
std::vector<int32_t> moves(uint32_t count) {
  if (count == 1) return {0};
  if (count == 2) return {-1, 0};
  const int32_t reach = count > 2 * kReach ? kReach : 1;
  return {-reach, 0, reach};
}

class DisparityProbe {
 public:
  DisparityProbe(const ViewProvider& views, const StreamHeader& header)
      : views_(views), header_(header), geometry_(header) {
    for (const int32_t rows : moves(header.rows)) {
      for (const int32_t cols : moves(header.cols)) add_view(rows, cols);
    }
  }

  CoarseResult search(int row_scale) const {
    const PaddedPlane reference(luma(middle()), header_.width, header_.height, header_.window + 10);
    StreamHeader header = header_;
    header.row_scale = row_scale;
    DisparitySearch search = disparity_search(header);
    search.targets = targets_;
    for (size_t i = 0; i < planes_.size(); ++i) {
      search.targets[i].plane = &planes_[i];
      search.targets[i].first.plane = &reference;
    }
    search.lambda = {kNoResidual};
    search.bound = reference_bound(Plane::kY, header_.depth, true);
    search.grid_log2 = kProbeGridLog2;
    const int32_t limit = std::min(kMaxDisparityPerView, std::max(1, header_.window / farthest_));
    return coarse_disparities(search, limit << header_.disparity_precision);
  }

 private:
  ImagePos middle() const { return middle_of(views_.shape()); }
  SamplePlane luma(ImagePos at) const { return view_planes(views_, geometry_, at)[0]; }

  // The view that is `rows` below and `cols` to the right of the middle.
  void add_view(int32_t rows, int32_t cols) {
    if (rows == 0 && cols == 0) return;
    farthest_ = std::max({farthest_, std::abs(rows), std::abs(cols)});
    targets_.push_back({nullptr, {nullptr, -rows, -cols}, {}});
    planes_.push_back(luma(moved(middle(), rows, cols)));
  }

  const ViewProvider& views_;
  const StreamHeader& header_;
  Geometry geometry_;
  std::vector<SearchTarget> targets_;
  std::vector<SamplePlane> planes_;
  int32_t farthest_ = 1;
};

void probe_disparities(const ViewProvider& views, const StreamHeader& header,
                       LightFieldProbe& found) {
  const DisparityProbe probe(views, header);
  const CoarseResult down = probe.search(16);
  found.disparities = down.range;
  if (header.rows == 1) return;
  const CoarseResult up = probe.search(-16);
  if (up.error >= down.error) return;
  found.disparities = up.range;
  found.row_scale = -16;
}

// The view in the middle as a key image of a usual group, refined for the views around it.
ImagePlanes middle_key(const ViewProvider& views, StreamHeader header,
                       const LightFieldProbe& found) {
  const ImagePos middle = middle_of(views.shape());
  const Geometry geometry(header);
  ImagePlanes key = view_planes(views, geometry, middle);
  if (!header.has(Feature::kSharedDisparity)) return key;
  header.row_scale = found.row_scale;
  const PaddedPlane reference(key[0], header.width, header.height, header.window + 10);
  DisparitySearch search = disparity_search(header);
  search.bound = reference_bound(Plane::kY, header.depth, true);
  search.lambda = kUsualLambda;
  std::vector<RefinementTarget> targets;
  for (const int32_t rows : moves(header.rows)) {
    for (const int32_t cols : moves(header.cols)) {
      if (rows == 0 && cols == 0) continue;
      const ImagePos at = moved(middle, rows, cols);
      targets.push_back({view_planes(views, geometry, at), at, {}, {}});
      search.targets.push_back({nullptr, {&reference, -rows, -cols}, {}});
    }
  }
  for (size_t i = 0; i < targets.size(); ++i) search.targets[i].plane = &targets[i].planes[0];
  search.images = std::max(targets.size(), kUsualImages);
  if (targets.empty()) return key;
  const DisparityGrid grid = search_disparities(search, found.disparities);
  refine_key({header,
              geometry,
              middle,
              grid,
              targets,
              search.images,
              {kUsualLambda, kUsualLambda, kUsualLambda}},
             key);
  return key;
}

void probe_keys(const ViewProvider& views, const StreamHeader& header, LightFieldProbe& found) {
  const Geometry geometry(header);
  const ImagePlanes planes = middle_key(views, header, found);
  parallel_for(planes.size(), [&](size_t p) {
    const PlaneShape& shape = geometry.plane(kPlanes[p]);
    found.keys[p] = KeyCurve(cropped(planes[p], shape.width, shape.height),
                             {header.depth + (p > 0 ? 1 : 0), p > 0});
  });
}

}  // namespace

LightFieldProbe probe_light_field(const ViewProvider& views, const StreamHeader& header) {
  LightFieldProbe found;
  if (header.has(Feature::kSharedDisparity)) probe_disparities(views, header, found);
  if (header.has(Feature::kLossyKeys)) probe_keys(views, header, found);
  return found;
}

}  // namespace hmlfc
