#include "decoder/golden/block_decoder.hpp"

#include "arithmetic/reconstruct.hpp"
#include "arithmetic/watch.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/golden/motion_reference.hpp"
#include "decoder/golden/motion_walk.hpp"
#include "decoder/plane_block.hpp"

namespace hmlfc {
namespace {

// What the stream says about one block of one image.
struct CodedSite {
  BlockMotion motion;
  CodedBlock block;
};

// The motion that a tile record's own vector stands for (TIL-7).
BlockMotion entry_motion(const Geometry& geometry, const BlockSite& site, const BlockEntry& entry) {
  BlockMotion motion;
  if (!entry.has_motion()) return motion;
  motion.count = 1;
  motion.negative = entry.negative;
  motion.references[0] = {geometry.reference_of(site.level, {site.image_row, site.image_col}),
                          {entry.dx, entry.dy, 0, 0}};
  return motion;
}

// Motion, then residual (MOT-10); or both from one record (TIL-1).
Result<CodedSite> read_site(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  const bool motion_tiles = stream.header.has(Feature::kMotionTiles);
  const bool predictive =
      !stream.geometry.is_reference(site.level, {site.image_row, site.image_col});
  BlockMotion motion;
  if (motion_tiles && predictive) {
    const auto read = walk_to_motion(stream, probe);
    if (!read) return tl::unexpected(read.error());
    motion = *read;
  }
  auto block = walk_to_block(stream, probe);
  if (!block) return tl::unexpected(block.error());
  if (!motion_tiles) motion = entry_motion(stream.geometry, site, block->entry);
  return CodedSite{motion, *block};
}

// A of DEC-3, with what it is made of.
Result<BlockValues> predict(const DecodeSources& sources, const BlockValues& parent,
                            const BlockMotion& motion, const Probe& probe) {
  probe.stage("parent", "DEC-3", parent.span());
  BlockValues prediction = parent;
  if (motion.count != 0) {
    const StreamView& stream = sources.stream;
    const SampleRange range = sample_range(probe.site.plane, stream.header.depth);
    const bool keyed = stream.geometry.level(probe.site.level).keyed;
    const auto reference = read_motion_reference(sources, motion, probe);
    if (!reference) return reference;
    const bool motion_tiles = stream.header.has(Feature::kMotionTiles);
    probe.stage("reference", motion_tiles ? "MOT-9" : "DEC-4", reference->span());
    for (size_t i = 0; i < parent.size(); ++i) {
      const int32_t base = keyed ? 0 : parent[i];  // EXT-5
      prediction[i] = motion_prediction(base, motion.negative, (*reference)[i], range);
    }
  }
  probe.stage("prediction", "DEC-3", prediction.span());
  return prediction;
}

// One image's block on top of its parent's samples (DEC-3, DEC-6), in the order of DEC-7 and
// MOT-10.
Result<BlockValues> decode_level(const DecodeSources& sources, const BlockValues& parent,
                                 const Probe& probe) {
  const StreamHeader& header = sources.stream.header;
  const SampleRange range = sample_range(probe.site.plane, header.depth);
  const auto coded = read_site(sources.stream, probe);
  if (!coded) return tl::unexpected(coded.error());
  const auto prediction = predict(sources, parent, coded->motion, probe);
  if (!prediction) return prediction;

  BlockValues sample = *prediction;
  if (coded->block.entry.has_residual()) {
    const BlockValues& residual = coded->block.residual;
    probe.stage("residual", header.has(Feature::kResidualStep) ? "STP-3" : "TIL-10",
                residual.span());
    for (size_t i = 0; i < sample.size(); ++i) {
      sample[i] = add_residual((*prediction)[i], residual[i], range);
    }
  }
  for (const int32_t value : sample.span()) watch("sample, parent P", value, range);
  probe.stage("sample", "DEC-3", sample.span());
  return sample;
}

// The block of a key image (DEC-2).
Result<BlockValues> decode_key_block(const DecodeSources& sources, const Probe& probe) {
  const BlockSite& site = probe.site;
  const auto plane = sources.keys.plane(site.level, {site.image_row, site.image_col}, site.plane);
  if (!plane) return tl::unexpected(plane.error());
  const unsigned size = sources.stream.geometry.block_size();
  BlockValues sample = block_of_plane(**plane, size, site.bx, site.by);
  probe.stage("sample", "DEC-2", sample.span());
  return sample;
}

}  // namespace

int first_level(const Geometry& geometry, int level, ImagePos image) {
  int l = level;
  while (l < geometry.top() && !geometry.is_key(l, geometry.ancestor(image, level, l))) ++l;
  return l;
}

Result<BlockValues> decode_block(const DecodeSources& sources, const BlockSite& site,
                                 const Probe& probe) {
  const Geometry& geometry = sources.stream.geometry;
  const ImagePos own{site.image_row, site.image_col};
  BlockValues samples(geometry.block_size());
  for (int level = first_level(geometry, site.level, own); level >= site.level; --level) {
    const ImagePos image = geometry.ancestor(own, site.level, level);
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
