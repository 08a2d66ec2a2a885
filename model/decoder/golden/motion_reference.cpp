#include "decoder/golden/motion_reference.hpp"

#include "arithmetic/watch.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/plane_block.hpp"
#include "decoder/reference_blocks.hpp"

namespace hmlfc {
namespace {

// Reference samples at a keyed level: a key image (DEC-4, EXT-5).
class KeyReference final : public ReferenceBlocks {
 public:
  KeyReference(const SamplePlane& plane, unsigned block_size)
      : plane_(plane), block_size_(block_size) {}

  Result<BlockValues> block(uint32_t bx, uint32_t by) override {
    return block_of_plane(plane_, block_size_, bx, by);
  }

 private:
  const SamplePlane& plane_;
  unsigned block_size_;
};

// Residuals of a reference image at another level, read from the stream when asked for (DEC-4).
class OnDemandReference final : public ReferenceBlocks {
 public:
  OnDemandReference(const StreamView& stream, const Probe& probe)
      : stream_(stream), probe_(probe) {}

  Result<BlockValues> block(uint32_t bx, uint32_t by) override {
    BlockSite site = probe_.site;
    site.bx = bx;
    site.by = by;
    auto coded = walk_to_block(stream_, probe_.at(site));
    if (!coded) return tl::unexpected(coded.error());
    return coded->residual;
  }

 private:
  const StreamView& stream_;
  Probe probe_;
};

// The values of ref in `area` of reference image `image`.
Result<ReferenceWindow> read_window(const DecodeSources& sources, ImagePos image,
                                    const ReferenceArea& area, const Probe& probe) {
  const BlockSite& site = probe.site;
  const Geometry& geometry = sources.stream.geometry;
  const unsigned size = geometry.block_size();
  const PlaneShape& plane = geometry.plane(site.plane);
  if (geometry.level(site.level).keyed) {
    const auto key = sources.keys.plane(site.level, image, site.plane);
    if (!key) return tl::unexpected(key.error());
    KeyReference reference(**key, size);
    return gather_reference(reference, plane, size, area);
  }
  if (sources.references != nullptr) {
    const auto sparse = sources.references->plane(site.level, image, site.plane);
    if (!sparse) return tl::unexpected(sparse.error());
    SparseReference reference(**sparse);
    return gather_reference(reference, plane, size, area);
  }
  BlockSite reference_site = site;
  reference_site.image_row = image.row;
  reference_site.image_col = image.col;
  OnDemandReference reference(sources.stream, probe.at(reference_site));
  return gather_reference(reference, plane, size, area);
}

// The range of the plane at `probe.site`.
SampleRange range_of(const DecodeSources& sources, const Probe& probe) {
  return sample_range(probe.site.plane, sources.stream.header.depth);
}

// I of MOT-9 over the block at `probe.site`. Columns and rows of weight 0 are not read.
Result<BlockValues> interpolate(const DecodeSources& sources, const ReferenceMotion& motion,
                                const Probe& probe) {
  const unsigned size = sources.stream.geometry.block_size();
  const SubpelVector& vector = motion.vector;
  const unsigned right = vector.fx == 0 ? 0 : 1;
  const unsigned below = vector.fy == 0 ? 0 : 1;
  const ReferenceArea area{static_cast<int32_t>(probe.site.bx * size) + vector.ix,
                           static_cast<int32_t>(probe.site.by * size) + vector.iy, size + right,
                           size + below};
  const auto window = read_window(sources, motion.image, area, probe);
  if (!window) return tl::unexpected(window.error());
  const TapWeights weights = tap_weights(vector.fx, vector.fy);
  const SampleRange range = range_of(sources, probe);
  BlockValues sums(size);
  for (unsigned y = 0; y < size; ++y) {
    for (unsigned x = 0; x < size; ++x) {
      sums.at(x, y) =
          weighted_sum(weights, {window->at(x, y), window->at(x + right, y),
                                 window->at(x, y + below), window->at(x + right, y + below)});
      watch("ref", window->at(x, y), range);
      watch("I", sums.at(x, y), range);
    }
  }
  return sums;
}

}  // namespace

Result<BlockValues> read_motion_reference(const DecodeSources& sources, const BlockMotion& motion,
                                          const Probe& probe) {
  auto first = interpolate(sources, motion.references[0], probe);
  if (!first) return first;
  BlockValues reference(first->block_size());
  if (motion.count == 1) {
    for (size_t i = 0; i < reference.size(); ++i) reference[i] = one_reference_value((*first)[i]);
    return reference;
  }
  const SampleRange range = range_of(sources, probe);
  const auto second = interpolate(sources, motion.references[1], probe);
  if (!second) return second;
  for (size_t i = 0; i < reference.size(); ++i) {
    watch("I_first + I_second + 64", two_reference_sum((*first)[i], (*second)[i]), range);
    reference[i] = two_reference_value((*first)[i], (*second)[i]);
  }
  return reference;
}

}  // namespace hmlfc
