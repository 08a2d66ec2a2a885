#include "samples/block_decoder.hpp"

#include "samples/reference_blocks.hpp"
#include "values/reconstruct.hpp"

namespace hmlfc {
namespace {

// A block of a plane held in memory (DEC-2); positions outside the plane are 0.
BlockValues block_of_plane(const SamplePlane& plane, unsigned block_size, uint32_t bx,
                           uint32_t by) {
  BlockValues values(block_size);
  for (unsigned j = 0; j < block_size; ++j) {
    for (unsigned i = 0; i < block_size; ++i) {
      const uint32_t x = bx * block_size + i;
      const uint32_t y = by * block_size + j;
      if (x < plane.width && y < plane.height) values.at(i, j) = plane.at(x, y);
    }
  }
  return values;
}

// Reference samples at the top level: a key image (DEC-4).
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

// Residuals of a reference image below the top, read from the stream when asked for (DEC-4).
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

// ref(x + dx, y + dy) over the block at `probe.site` (DEC-4, DEC-5).
Result<BlockValues> read_reference(const DecodeSources& sources, const BlockEntry& entry,
                                   const Probe& probe) {
  const BlockSite& site = probe.site;
  const Geometry& geometry = sources.stream.geometry;
  const unsigned size = geometry.block_size();
  const PlaneShape& plane = geometry.plane(site.plane);
  const ImagePos image = geometry.reference_of(site.level, {site.image_row, site.image_col});
  const int32_t x = static_cast<int32_t>(site.bx * size) + entry.dx;
  const int32_t y = static_cast<int32_t>(site.by * size) + entry.dy;

  if (site.level == geometry.top()) {
    const auto key = sources.keys.plane(image, site.plane);
    if (!key) return tl::unexpected(key.error());
    KeyReference reference(**key, size);
    return gather_reference(reference, plane, size, x, y);
  }
  if (sources.references != nullptr) {
    const auto sparse = sources.references->plane(site.level, image, site.plane);
    if (!sparse) return tl::unexpected(sparse.error());
    SparseReference reference(**sparse);
    return gather_reference(reference, plane, size, x, y);
  }
  BlockSite reference_site = site;
  reference_site.image_row = image.row;
  reference_site.image_col = image.col;
  OnDemandReference reference(sources.stream, probe.at(reference_site));
  return gather_reference(reference, plane, size, x, y);
}

// One image's block on top of its parent's samples (DEC-3, DEC-6), in the order of DEC-7.
Result<BlockValues> decode_level(const DecodeSources& sources, const BlockValues& parent,
                                 const Probe& probe) {
  const SampleRange range = sample_range(probe.site.plane, sources.stream.header.depth);
  const auto coded = walk_to_block(sources.stream, probe);
  if (!coded) return tl::unexpected(coded.error());

  BlockValues prediction = parent;
  probe.stage("parent", "DEC-3", parent.span());
  if (coded->entry.has_motion()) {
    const auto reference = read_reference(sources, coded->entry, probe);
    if (!reference) return tl::unexpected(reference.error());
    probe.stage("reference", "DEC-4", reference->span());
    for (size_t i = 0; i < parent.size(); ++i) {
      prediction[i] = motion_prediction(parent[i], coded->entry.negative, (*reference)[i], range);
    }
  }
  probe.stage("prediction", "DEC-3", prediction.span());

  BlockValues sample = prediction;
  if (coded->entry.has_residual()) {
    probe.stage("residual", "TIL-10", coded->residual.span());
    for (size_t i = 0; i < sample.size(); ++i) {
      sample[i] = add_residual(prediction[i], coded->residual[i], range);
    }
  }
  probe.stage("sample", "DEC-3", sample.span());
  return sample;
}

// The block of a key image (DEC-2).
Result<BlockValues> decode_key_block(const DecodeSources& sources, const Probe& probe) {
  const BlockSite& site = probe.site;
  const auto plane = sources.keys.plane({site.image_row, site.image_col}, site.plane);
  if (!plane) return tl::unexpected(plane.error());
  const unsigned size = sources.stream.geometry.block_size();
  BlockValues sample = block_of_plane(**plane, size, site.bx, site.by);
  probe.stage("sample", "DEC-2", sample.span());
  return sample;
}

}  // namespace

Result<BlockValues> decode_block(const DecodeSources& sources, const BlockSite& site,
                                 const Probe& probe) {
  const Geometry& geometry = sources.stream.geometry;
  BlockValues samples(geometry.block_size());
  for (int level = geometry.top(); level >= site.level; --level) {
    const ImagePos image = geometry.ancestor({site.image_row, site.image_col}, site.level, level);
    BlockSite at = site;
    at.level = level;
    at.image_row = image.row;
    at.image_col = image.col;
    const bool key = geometry.is_key(level, image);
    auto decoded = key ? decode_key_block(sources, probe.at(at))
                       : decode_level(sources, samples, probe.at(at));
    if (!decoded) return decoded;
    samples = *decoded;
  }
  return samples;
}

}  // namespace hmlfc
