#include "encoder/extended_level.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/motion_choice.hpp"
#include "encoder/predicted_plane.hpp"
#include "encoder/stepped_plane.hpp"
#include "encoder/view_error.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

constexpr size_t kMotion = kPlaneCount;

// What the images of one group, and its neighbours, are predicted from.
struct GroupReference {
  std::array<std::unique_ptr<PaddedPlane>, kPlaneCount> planes;
  DisparityGrid grid;
};

class LevelEncoder {
 public:
  explicit LevelEncoder(const ExtendedLevelTask& task)
      : task_(task),
        geometry_(*task.geometry),
        header_(*task.header),
        shape_(geometry_.level(task.level)),
        motion_(header_.has(Feature::kMotionTiles)),
        rules_(vector_rules(header_)),
        groups_(size_t{shape_.group_rows()} * shape_.group_cols()) {
    for (uint32_t r = 0; r < shape_.rows; ++r) {
      for (uint32_t c = 0; c < shape_.cols; ++c) {
        (geometry_.is_reference(task.level, {r, c}) ? references_ : predictive_).push_back({r, c});
      }
    }
  }

  void run() {
    parallel_for(references_.size(), [&](size_t i) { encode_reference(references_[i]); });
    if (motion_ && !predictive_.empty()) {
      for (const ImagePos at : references_) find_disparities(at);
    }
    parallel_for(predictive_.size(), [&](size_t i) { encode_predictive(predictive_[i]); });
  }

 private:
  GroupReference& group(ImagePos at) {
    const ImagePos g = geometry_.group_of(task_.level, at);
    return groups_[size_t{g.row} * shape_.group_cols() + g.col];
  }

  ImagePlanes original(ImagePos at) const {
    if (task_.level == 0) return view_planes(*task_.light_field, geometry_, at);
    return task_.tree->at(geometry_, task_.level, at);
  }

  const SamplePlane* parent(ImagePos at, size_t plane) const {
    if (task_.level == geometry_.top()) return nullptr;
    const ImagePos above = geometry_.ancestor(at, task_.level, task_.level + 1);
    return &task_.tree->at(geometry_, task_.level + 1, above)[plane];
  }

  ExtendedImageCode& code(ImagePos at) const {
    return (*task_.codes)[static_cast<size_t>(geometry_.image_number(task_.level, at))];
  }

  void encode_reference(ImagePos at) {
    ImagePlanes planes = original(at);
    for (const Plane plane : kPlanes) {
      const auto p = static_cast<size_t>(plane);
      SamplePlane reference;
      if (shape_.keyed) {
        planes[p] = encode_key(at, plane, planes[p]);
        reference = planes[p];
      } else {
        SamplePlane prediction(planes[p].width, planes[p].height);
        if (const SamplePlane* above = parent(at, p)) prediction = *above;
        EncodedPlane encoded = encode_residuals(geometry_, plane, header_.depth, planes[p],
                                                prediction, true, task_.targets[p].residuals);
        code(at)[p] = std::move(encoded.code);
        planes[p] = std::move(encoded.samples);
        reference = std::move(encoded.residuals);
      }
      const PlaneShape& shape = geometry_.plane(plane);
      // Vectors reach `window` samples, interpolation one more, a block B - 1 beyond the plane.
      group(at).planes[p] =
          std::make_unique<PaddedPlane>(reference, shape.width, shape.height, header_.window + 10);
    }
    finish(at, std::move(planes));
  }

  // Codes one plane of a key image; what a decoder makes of it, in whole blocks.
  SamplePlane encode_key(ImagePos at, Plane plane, const SamplePlane& original) const {
    const PlaneShape& shape = geometry_.plane(plane);
    SamplePlane inside = cropped(original, shape.width, shape.height);
    const bool chroma = plane != Plane::kY;
    const SamplePrecision precision{header_.depth + (chroma ? 1 : 0), chroma};
    const double error = task_.targets[static_cast<size_t>(plane)].key_error;
    auto coded = error > 0 ? encode_jpeg2000_lossy(inside, precision, error)
                           : encode_jpeg2000(inside, precision);
    if (!coded) throw std::bad_alloc();
    if (error > 0) {
      auto decoded = decode_jpeg2000(*coded, shape.width, shape.height, precision);
      if (!decoded) throw std::bad_alloc();
      inside = std::move(*decoded);
      const SampleRange range = sample_range(plane, header_.depth);
      for (int16_t& sample : inside.samples) {
        sample = static_cast<int16_t>(clamp(sample, range.lo, range.hi));
      }
    }
    const size_t entry = static_cast<size_t>(geometry_.key_number(task_.level, at)) * kPlaneCount +
                         static_cast<size_t>(plane);
    task_.keys->crcs[entry] = sample_crc(inside);
    task_.keys->codestreams[entry] = std::move(*coded);
    SamplePlane blocks(original.width, original.height);
    for (uint32_t y = 0; y < shape.height; ++y) {
      std::copy(inside.row(y).begin(), inside.row(y).end(), blocks.row(y).begin());
    }
    extend_borders(blocks, shape.width, shape.height);
    return blocks;
  }

  // The plane that motion is chosen on: Y, at levels that are not keyed less the parent.
  SamplePlane motion_target(ImagePos at, SamplePlane luma) const {
    const SamplePlane* above = shape_.keyed ? nullptr : parent(at, 0);
    if (above == nullptr) return luma;
    for (size_t i = 0; i < luma.samples.size(); ++i) {
      luma.samples[i] = static_cast<int16_t>(luma.samples[i] - above->samples[i]);
    }
    return luma;
  }

  void find_disparities(ImagePos reference) {
    GroupReference& own = group(reference);
    std::vector<SamplePlane> planes;
    DisparitySearch search;
    for (const ImagePos at : predictive_) {
      if (geometry_.reference_of(task_.level, at) != reference) continue;
      planes.push_back(motion_target(at, original(at)[0]));
      search.targets.push_back(
          {nullptr, static_cast<int32_t>(reference.row) - static_cast<int32_t>(at.row),
           static_cast<int32_t>(reference.col) - static_cast<int32_t>(at.col)});
    }
    for (size_t i = 0; i < planes.size(); ++i) search.targets[i].plane = &planes[i];
    fill(search, own);
    own.grid = search_disparities(search, task_.disparities);
    store_disparities(reference, own.grid);
  }

  void fill(DisparitySearch& search, const GroupReference& own) const {
    search.reference = own.planes[0].get();
    search.width = header_.width;
    search.height = header_.height;
    search.rules = rules_;
    search.vector_precision = header_.vector_precision;
    search.disparity_precision = header_.disparity_precision;
    search.grid_log2 = header_.disparity_grid_log2;
    search.tile_log2 = header_.motion_tile_log2;
    search.lambda = task_.motion_lambda;
  }

  void store_disparities(ImagePos reference, const DisparityGrid& grid) {
    const MotionPlaneShape& shape = geometry_.motion_planes()[0];
    const uint32_t per_tile = 1u << (header_.motion_tile_log2 - header_.disparity_grid_log2);
    PlaneCode& out = code(reference)[kMotion];
    for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
      for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
        std::vector<int16_t> values;
        for (uint32_t y = ty * per_tile; y < std::min((ty + 1) * per_tile, grid.blocks_y); ++y) {
          for (uint32_t x = tx * per_tile; x < std::min((tx + 1) * per_tile, grid.blocks_x); ++x) {
            values.push_back(grid.at(x, y));
          }
        }
        append(out, write_disparity_tile(values));
      }
    }
  }

  static void append(PlaneCode& out, const std::vector<uint8_t>& record) {
    out.record_sizes.push_back(static_cast<uint32_t>(record.size()));
    out.records.insert(out.records.end(), record.begin(), record.end());
  }

  void encode_predictive(ImagePos at) {
    ImagePlanes planes = original(at);
    const ReferenceImages places = reference_images(geometry_, task_.level, at);
    std::vector<MotionTileCode> tiles;
    if (motion_) {
      tiles = choose_tiles(at, planes[0], places);
      const PaletteFields fields{header_.has(Feature::kTwoReferences), !shape_.keyed};
      for (const MotionTileCode& tile : tiles) {
        append(code(at)[kMotion], write_motion_tile(tile, fields));
      }
    }
    for (const Plane plane : kPlanes) {
      const auto p = static_cast<size_t>(plane);
      const SamplePlane prediction = predict(at, plane, places, tiles, planes[p]);
      EncodedPlane encoded = encode_residuals(geometry_, plane, header_.depth, planes[p],
                                              prediction, false, task_.targets[p].residuals);
      code(at)[p] = std::move(encoded.code);
      planes[p] = std::move(encoded.samples);
    }
    finish(at, std::move(planes));
  }

  ReferencePlanes reference_planes(const ReferenceImages& places, size_t plane) {
    ReferencePlanes planes{};
    for (size_t k = 0; k < places.size(); ++k) planes[k] = group(places[k]).planes[plane].get();
    return planes;
  }

  std::vector<MotionTileCode> choose_tiles(ImagePos at, const SamplePlane& luma,
                                           const ReferenceImages& places) {
    const SamplePlane target = motion_target(at, luma);
    MotionTask task;
    task.target = &target;
    task.references = reference_planes(places, 0);
    task.places = places;
    task.at = at;
    task.grid = &group(at).grid;
    task.rules = rules_;
    task.vector_precision = header_.vector_precision;
    task.shape = geometry_.motion_planes()[0];
    task.tile_log2 = header_.motion_tile_log2;
    task.grid_log2 = header_.disparity_grid_log2;
    task.least_block_log2 = header_.block_log2;
    task.keyed = shape_.keyed;
    task.two_references = header_.has(Feature::kTwoReferences);
    task.choices = task_.effort.choices;
    task.lambda = task_.motion_lambda;
    return choose_motion(task);
  }

  SamplePlane predict(ImagePos at, Plane plane, const ReferenceImages& places,
                      const std::vector<MotionTileCode>& tiles, const SamplePlane& original) {
    const auto p = static_cast<size_t>(plane);
    const SamplePlane* above = parent(at, p);
    if (!motion_) return above != nullptr ? *above : SamplePlane(original.width, original.height);
    PredictionTask task;
    task.geometry = &geometry_;
    task.plane = plane;
    task.depth = header_.depth;
    task.parent = above;
    task.keyed = shape_.keyed;
    task.references = reference_planes(places, p);
    task.places = places;
    task.at = at;
    task.grid = &group(at).grid;
    task.rules = rules_;
    task.vector_precision = header_.vector_precision;
    task.tile_log2 = header_.motion_tile_log2;
    task.grid_log2 = header_.disparity_grid_log2;
    if (shape_.keyed) {
      const bool two = header_.has(Feature::kTwoReferences);
      task.default_symbol = {static_cast<uint8_t>(two ? 1 : 0), kChoiceOwn};
    }
    task.tiles = tiles;
    return predict_plane(task);
  }

  void finish(ImagePos at, ImagePlanes reconstructed) {
    const EncodeObserver& observer = *task_.observer;
    if (observer.reconstructed) observer.reconstructed(task_.level, at, reconstructed);
    if (task_.level > 0) {
      task_.tree->at(geometry_, task_.level, at) = std::move(reconstructed);
    } else {
      const ErrorSums error =
          view_error(*task_.light_field, at, reconstructed, header_.chroma_format);
      const std::scoped_lock lock(error_mutex_);
      task_.error->add(error);
    }
    if (observer.image_done) observer.image_done();
  }

  const ExtendedLevelTask& task_;
  const Geometry& geometry_;
  const StreamHeader& header_;
  const LevelShape& shape_;
  bool motion_;
  VectorRules rules_;
  std::vector<GroupReference> groups_;
  std::vector<ImagePos> references_;
  std::vector<ImagePos> predictive_;
  std::mutex error_mutex_;
};

}  // namespace

void encode_extended_level(const ExtendedLevelTask& task) { LevelEncoder(task).run(); }

}  // namespace hmlfc
