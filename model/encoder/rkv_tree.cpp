#include "encoder/rkv_tree.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"

namespace hmlfc {
namespace {

// Sums of the planes of a cluster's images.
class ClusterMean {
 public:
  void add(const ImagePlanes& image) {
    for (size_t p = 0; p < sums_.size(); ++p) {
      std::vector<int32_t>& sum = sums_[p];
      const std::vector<int16_t>& samples = image[p].samples;
      sum.resize(samples.size());
      for (size_t i = 0; i < samples.size(); ++i) sum[i] += samples[i];
      shapes_[p] = {image[p].width, image[p].height};
    }
    ++count_;
  }

  ImagePlanes mean() const {
    ImagePlanes planes;
    for (size_t p = 0; p < sums_.size(); ++p) {
      planes[p] = SamplePlane(shapes_[p].first, shapes_[p].second);
      std::transform(sums_[p].begin(), sums_[p].end(), planes[p].samples.begin(), [&](int32_t sum) {
        return static_cast<int16_t>(round_half_up_div(sum, count_));
      });
    }
    return planes;
  }

 private:
  std::array<std::vector<int32_t>, kPlaneCount> sums_;
  std::array<std::pair<uint32_t, uint32_t>, kPlaneCount> shapes_;
  int64_t count_ = 0;
};

}  // namespace

RkvTree build_rkv_tree(const ViewProvider& views, const Geometry& geometry,
                       const EncodePart& part) {
  RkvTree tree;
  for (int level = 1; level <= geometry.top(); ++level) {
    tree.levels.emplace_back(static_cast<size_t>(geometry.level(level).images()));
    const std::vector<ImagePos>& images = part.levels[static_cast<size_t>(level)].originals;
    parallel_for(images.size(), [&](size_t i) {
      ClusterMean mean;
      for (const ImagePos child : geometry.descendants(images[i], level, level - 1)) {
        if (level == 1) {
          mean.add(view_planes(views, geometry, child));
        } else {
          mean.add(tree.at(geometry, level - 1, child));
        }
      }
      tree.at(geometry, level, images[i]) = mean.mean();
    });
  }
  return tree;
}

}  // namespace hmlfc
