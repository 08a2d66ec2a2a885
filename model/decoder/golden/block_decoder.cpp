// Functions stand in the order in which decoding a block calls them.
#include "decoder/golden/block_decoder.hpp"

#include <vector>

#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "decoder/golden/block_walk.hpp"

namespace hmlfc {
namespace {

// One block of one image as the stream describes it.
struct CodedSite {
  BlockMotion motion;
  CodedBlock block;
};

// One block of one image: that at `probe.site`.
class LevelDecoder {
 public:
  LevelDecoder(const DecodeSources& sources, const Probe& probe)
      : sources_(sources),
        stream_(sources.stream),
        probe_(probe),
        site_(probe.site),
        keyed_(stream_.geometry.level(site_.level).keyed),
        range_(sample_range(site_.plane, stream_.header.depth)) {}

  Result<BlockValues> decode_key_block() const;
  Result<BlockValues> decode(const BlockValues& parent) const;

 private:
  Result<CodedSite> read_site() const;
  void report_vectors(const BlockMotion& motion) const;
  Result<BlockValues> predict(const BlockValues& parent, const BlockMotion& motion) const;
  Result<BlockValues> reference(const BlockMotion& motion) const;
  Result<BlockValues> interpolate(const ReferenceMotion& motion) const;
  Result<BlockValues> reference_block(ImagePos image, uint32_t bx, uint32_t by) const;

  ImagePos image() const { return {site_.image_row, site_.image_col}; }
  unsigned block_size() const { return stream_.geometry.block_size(); }

  const DecodeSources& sources_;
  const StreamView& stream_;
  const Probe& probe_;
  const BlockSite& site_;
  bool keyed_;
  SampleRange range_;
};

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
    const Probe at =
        probe.at({level, image.row, image.col, site.plane, site.bx, site.by, site.tile});
    const LevelDecoder decoder(sources, at);
    auto decoded =
        geometry.is_key(level, image) ? decoder.decode_key_block() : decoder.decode(samples);
    if (!decoded) return decoded;
    samples = *decoded;
  }
  return samples;
}

// The block of a key image (DEC-2).
Result<BlockValues> LevelDecoder::decode_key_block() const {
  const auto plane = sources_.keys.plane(site_.level, image(), site_.plane);
  if (!plane) return tl::unexpected(plane.error());
  BlockValues sample = block_of_plane(**plane, block_size(), site_.bx, site_.by);
  probe_.stage("sample", "DEC-2", sample.span());
  return sample;
}

// The block of any other image on top of its parent's samples (DEC-3, DEC-6), in the order of DEC-7
// and MOT-10.
Result<BlockValues> LevelDecoder::decode(const BlockValues& parent) const {
  const auto coded = read_site();
  if (!coded) return tl::unexpected(coded.error());
  report_vectors(coded->motion);
  const auto prediction = predict(parent, coded->motion);
  if (!prediction) return prediction;
  BlockValues sample = *prediction;
  if (coded->block.entry.has_residual()) {
    const BlockValues& residual = coded->block.residual;
    const bool steps = stream_.header.has(Feature::kResidualStep);
    probe_.stage("residual", steps ? "STP-3" : "TIL-10", residual.span());
    for (size_t i = 0; i < sample.size(); ++i) {
      sample[i] = add_residual((*prediction)[i], residual[i], range_);
    }
  }
  for (const int32_t value : sample.span()) watch("sample, parent P", value, range_);
  probe_.stage("sample", "DEC-3", sample.span());
  return sample;
}

// Motion, then residual (MOT-10); or both from one record, the vector for the only reference
// (TIL-1, TIL-7).
Result<CodedSite> LevelDecoder::read_site() const {
  const bool motion_tiles = stream_.header.has(Feature::kMotionTiles);
  BlockMotion motion;
  if (motion_tiles && !stream_.geometry.is_reference(site_.level, image())) {
    const auto read = walk_to_motion(stream_, probe_);
    if (!read) return tl::unexpected(read.error());
    motion = *read;
  }
  const auto block = walk_to_block(stream_, probe_);
  if (!block) return tl::unexpected(block.error());
  const BlockEntry& entry = block->entry;
  if (!motion_tiles && entry.has_motion()) {
    const ImagePos reference = stream_.geometry.reference_of(site_.level, image());
    motion = {1, entry.negative, {{{reference, {entry.dx, entry.dy, 0, 0}}}}};
  }
  return CodedSite{motion, *block};
}

void LevelDecoder::report_vectors(const BlockMotion& motion) const {
  const char* clause = stream_.header.has(Feature::kMotionTiles) ? "MOT-8" : "TIL-7";
  for (unsigned i = 0; i < motion.count; ++i) {
    const auto& [image, vector] = motion.references[i];
    probe_.vector(image.row, image.col, 8 * vector.ix + vector.fx, 8 * vector.iy + vector.fy,
                  clause);
  }
}

// A of DEC-3; reports its stages (TRC-1).
Result<BlockValues> LevelDecoder::predict(const BlockValues& parent,
                                          const BlockMotion& motion) const {
  const bool has_motion = motion.count != 0;
  // EXT-5
  const BlockValues p = has_motion && keyed_ ? BlockValues(block_size()) : parent;
  probe_.stage("parent", "DEC-3", p.span());
  BlockValues prediction = p;
  if (has_motion) {
    const auto ref = reference(motion);
    if (!ref) return ref;
    const bool motion_tiles = stream_.header.has(Feature::kMotionTiles);
    probe_.stage("reference", motion_tiles ? "MOT-9" : "DEC-4", ref->span());
    for (size_t i = 0; i < p.size(); ++i) {
      prediction[i] = motion_prediction(p[i], motion.negative, (*ref)[i], range_);
    }
  }
  probe_.stage("prediction", "DEC-3", prediction.span());
  return prediction;
}

// R of MOT-9, which is ref(x + dx, y + dy) of DEC-3 with one reference and a vector of whole
// samples; in [-M, M].
Result<BlockValues> LevelDecoder::reference(const BlockMotion& motion) const {
  const auto first = interpolate(motion.references[0]);
  if (!first) return first;
  BlockValues reference(block_size());
  if (motion.count == 1) {
    for (size_t i = 0; i < reference.size(); ++i) reference[i] = one_reference_value((*first)[i]);
    return reference;
  }
  const auto second = interpolate(motion.references[1]);
  if (!second) return second;
  for (size_t i = 0; i < reference.size(); ++i) {
    watch("I_first + I_second + 64", two_reference_sum((*first)[i], (*second)[i]), range_);
    reference[i] = two_reference_value((*first)[i], (*second)[i]);
  }
  return reference;
}

// I of MOT-9 over the block. Columns and rows of weight 0 are not read.
Result<BlockValues> LevelDecoder::interpolate(const ReferenceMotion& motion) const {
  const unsigned size = block_size();
  const SubpelVector& vector = motion.vector;
  const unsigned right = vector.fx == 0 ? 0 : 1;
  const unsigned below = vector.fy == 0 ? 0 : 1;
  const ReferenceArea area{static_cast<int32_t>(site_.bx * size) + vector.ix,
                           static_cast<int32_t>(site_.by * size) + vector.iy, size + right,
                           size + below};
  const auto read_block = [&](uint32_t bx, uint32_t by) {
    return reference_block(motion.image, bx, by);
  };
  const auto window = gather_reference(read_block, stream_.geometry.plane(site_.plane), size, area);
  if (!window) return tl::unexpected(window.error());
  const TapWeights weights = tap_weights(vector.fx, vector.fy);
  BlockValues sums(size);
  for (unsigned y = 0; y < size; ++y) {
    for (unsigned x = 0; x < size; ++x) {
      sums.at(x, y) =
          weighted_sum(weights, {window->at(x, y), window->at(x + right, y),
                                 window->at(x, y + below), window->at(x + right, y + below)});
      watch("ref", window->at(x, y), range_);
      watch("I", sums.at(x, y), range_);
    }
  }
  return sums;
}

Result<ReferenceWindow> gather_reference(const BlockReader& read_block, const PlaneShape& plane,
                                         unsigned block_size, const ReferenceArea& area) {
  // DEC-5
  const auto inside = [](int32_t first, unsigned i, uint32_t size) {
    const int32_t at = first + static_cast<int32_t>(i);
    return static_cast<uint32_t>(clamp(at, 0, static_cast<int32_t>(size) - 1));
  };
  const auto column = [&](unsigned i) { return inside(area.x, i, plane.width); };
  const auto row = [&](unsigned j) { return inside(area.y, j, plane.height); };
  const uint32_t first_bx = column(0) / block_size;
  const uint32_t first_by = row(0) / block_size;
  const uint32_t last_bx = column(area.columns - 1) / block_size;
  const uint32_t last_by = row(area.rows - 1) / block_size;

  std::vector<BlockValues> touched;
  for (uint32_t by = first_by; by <= last_by; ++by) {
    for (uint32_t bx = first_bx; bx <= last_bx; ++bx) {
      const auto block = read_block(bx, by);
      if (!block) return tl::unexpected(block.error());
      touched.push_back(*block);
    }
  }
  ReferenceWindow window(area.columns, area.rows);
  for (unsigned j = 0; j < area.rows; ++j) {
    for (unsigned i = 0; i < area.columns; ++i) {
      const uint32_t x = column(i);
      const uint32_t y = row(j);
      const uint32_t which =
          (y / block_size - first_by) * (last_bx - first_bx + 1) + (x / block_size - first_bx);
      window.at(i, j) = touched[which].at(x % block_size, y % block_size);
    }
  }
  return window;
}

// A block of reference image `image` of this level: samples of a key image, or residuals (DEC-4,
// EXT-5).
Result<BlockValues> LevelDecoder::reference_block(ImagePos image, uint32_t bx, uint32_t by) const {
  if (keyed_) {
    const auto key = sources_.keys.plane(site_.level, image, site_.plane);
    if (!key) return tl::unexpected(key.error());
    return block_of_plane(**key, block_size(), bx, by);
  }
  const BlockSite at{site_.level, image.row, image.col, site_.plane, bx, by, site_.tile};
  if (sources_.held != nullptr) return sources_.held->block(at);
  auto coded = walk_to_block(stream_, probe_.at(at));
  if (!coded) return tl::unexpected(coded.error());
  return coded->residual;
}

Result<SamplePlane> decode_region_by_blocks(const DecodeSources& sources, int level, ImagePos image,
                                            Plane plane, const BlockRect& rect) {
  const unsigned size = sources.stream.geometry.block_size();
  SamplePlane samples((rect.bx1 - rect.bx0) * size, (rect.by1 - rect.by0) * size);
  for (uint32_t by = rect.by0; by < rect.by1; ++by) {
    for (uint32_t bx = rect.bx0; bx < rect.bx1; ++bx) {
      const auto block =
          decode_block(sources, {level, image.row, image.col, plane, bx, by}, Probe{});
      if (!block) return tl::unexpected(block.error());
      for (unsigned j = 0; j < size; ++j) {
        const auto row = samples.row((by - rect.by0) * size + j);
        for (unsigned i = 0; i < size; ++i) {
          row[(bx - rect.bx0) * size + i] = narrow<int16_t>(block->at(i, j));
        }
      }
    }
  }
  return samples;
}

}  // namespace hmlfc
