#include "encoder/level_encoder.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/view_error.hpp"
#include "encoder/view_planes.hpp"

namespace hmlfc {
namespace {

using References = std::array<std::optional<ReferencePlane>, kPlaneCount>;

// One reference group of a level.
class GroupEncoder {
 public:
  GroupEncoder(const LevelTask& task, ImagePos first, std::mutex& error_mutex)
      : task_(task), geometry_(*task.geometry), first_(first), error_mutex_(error_mutex) {}

  void run() {
    const LevelShape& shape = geometry_.level(task_.level);
    const ImagePos reference = geometry_.reference_of(task_.level, first_);
    std::vector<ImagePos> predictive;
    for (uint32_t r = first_.row; r < std::min(first_.row + shape.ref_rows, shape.rows); ++r) {
      for (uint32_t c = first_.col; c < std::min(first_.col + shape.ref_cols, shape.cols); ++c) {
        if (ImagePos{r, c} != reference) predictive.push_back({r, c});
      }
    }
    encode_reference(reference, !predictive.empty());
    parallel_for(predictive.size(), [&](size_t i) { encode_predictive(predictive[i]); });
  }

 private:
  ImagePlanes original(ImagePos at) const {
    if (task_.level == 0) return view_planes(*task_.light_field, geometry_, at);
    return task_.tree->at(geometry_, task_.level, at);
  }

  const SamplePlane* parent(ImagePos at, Plane plane) const {
    if (task_.level == geometry_.top()) return nullptr;
    const ImagePos above = geometry_.ancestor(at, task_.level, task_.level + 1);
    return &task_.tree->at(geometry_, task_.level + 1, above)[static_cast<size_t>(plane)];
  }

  ReferencePlane reference_plane(const SamplePlane& samples, Plane plane) const {
    const PlaneShape& shape = geometry_.plane(plane);
    const SamplePlane inside = cropped(samples, shape.width, shape.height);
    return ReferencePlane(inside.samples, shape.width, shape.height, task_.window);
  }

  PlaneTask plane_task(ImagePos at, Plane plane, const ImagePlanes& originals) const {
    PlaneTask task;
    task.geometry = &geometry_;
    task.plane = plane;
    task.depth = task_.light_field->shape().depth;
    task.window = task_.window;
    task.both_signs = task_.params->method != Method::kMc;
    task.original = &originals[static_cast<size_t>(plane)];
    task.parent = parent(at, plane);
    return task;
  }

  void encode_reference(ImagePos at, bool is_needed) {
    ImagePlanes planes = original(at);
    parallel_for(planes.size(), [&](size_t p) {
      const Plane plane = kPlanes[p];
      if (geometry_.is_key(task_.level, at)) {
        if (is_needed) references_[p].emplace(reference_plane(planes[p], plane));
        return;
      }
      PlaneTask task = plane_task(at, plane, planes);
      task.threshold = task_.params->threshold_ref;
      EncodedPlane encoded = encode_plane(task);
      if (is_needed) references_[p].emplace(reference_plane(encoded.residuals, plane));
      store(at, p, std::move(encoded.code));
      planes[p] = std::move(encoded.samples);
    });
    finish(at, std::move(planes));
  }

  void encode_predictive(ImagePos at) {
    ImagePlanes planes = original(at);
    parallel_for(planes.size(), [&](size_t p) {
      PlaneTask task = plane_task(at, kPlanes[p], planes);
      task.threshold = task_.params->threshold_pred;
      task.reference = &*references_[p];
      EncodedPlane encoded = encode_plane(task);
      store(at, p, std::move(encoded.code));
      planes[p] = std::move(encoded.samples);
    });
    finish(at, std::move(planes));
  }

  void store(ImagePos at, size_t plane, PlaneCode code) {
    const uint64_t image = geometry_.image_number(task_.level, at);
    (*task_.codes)[static_cast<size_t>(image)][plane] = std::move(code);
  }

  void finish(ImagePos at, ImagePlanes reconstructed) {
    const EncodeObserver& observer = *task_.observer;
    if (observer.reconstructed) observer.reconstructed(task_.level, at, reconstructed);
    if (task_.level > 0) {
      task_.tree->at(geometry_, task_.level, at) = std::move(reconstructed);
    } else {
      const ErrorSums error =
          view_error(*task_.light_field, at, reconstructed, task_.params->chroma);
      const std::scoped_lock lock(error_mutex_);
      task_.error->add(error);
    }
    if (observer.image_done) observer.image_done();
  }

  const LevelTask& task_;
  const Geometry& geometry_;
  ImagePos first_;
  std::mutex& error_mutex_;
  References references_;
};

}  // namespace

void encode_level(const LevelTask& task) {
  const LevelShape& shape = task.geometry->level(task.level);
  const uint32_t group_rows = ceil_div(shape.rows, shape.ref_rows);
  const uint32_t group_cols = ceil_div(shape.cols, shape.ref_cols);
  std::mutex error_mutex;
  parallel_for(size_t{group_rows} * group_cols, [&](size_t i) {
    const ImagePos first{static_cast<uint32_t>(i / group_cols) * shape.ref_rows,
                         static_cast<uint32_t>(i % group_cols) * shape.ref_cols};
    GroupEncoder(task, first, error_mutex).run();
  });
}

}  // namespace hmlfc
