#include "decoder/fast/region_decoder.hpp"

#include <algorithm>
#include <memory>

#include "arithmetic/reconstruct.hpp"
#include "arithmetic/widths.hpp"
#include "bits/bit_string.hpp"
#include "decoder/fast/reference_reader.hpp"
#include "decoder/fast/tile_blocks.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

// Adds one level to the samples of a region, in place: they come in as the parent's.
class LevelPass {
 public:
  LevelPass(const FastSources& sources, int level, ImagePos image, Plane plane,
            const BlockRect& rect, SamplePlane& samples)
      : sources_(sources),
        site_{level, image.row, image.col, plane, 0, 0},
        rect_(rect),
        samples_(samples),
        block_size_(sources.stream.geometry.block_size()),
        keyed_(sources.stream.geometry.level(level).keyed),
        range_(sample_range(plane, sources.stream.header.depth)) {}

  Result<void> run() {
    auto blocks = std::make_unique<TileBlocks>();
    for (uint32_t ty = rect_.by0 / kTileBlocks; ty * kTileBlocks < rect_.by1; ++ty) {
      for (uint32_t tx = rect_.bx0 / kTileBlocks; tx * kTileBlocks < rect_.bx1; ++tx) {
        site_.bx = tx * kTileBlocks;
        site_.by = ty * kTileBlocks;
        const uint64_t wanted = blocks_of_rect(rect_, site_.bx, site_.by);
        if (auto ok = read_tile_blocks(sources_.stream, site_, wanted, *blocks); !ok) return ok;
        if (auto ok = add_tile(*blocks, wanted); !ok) return ok;
      }
    }
    return {};
  }

 private:
  Result<void> add_tile(const TileBlocks& blocks, uint64_t wanted) {
    uint64_t left = (blocks.motion_mask | blocks.residual_mask) & wanted;
    for (; left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(left));
      if (has_bit(blocks.motion_mask, k)) {
        if (auto ok = add_motion(blocks, k); !ok) return ok;
      }
      if (has_bit(blocks.residual_mask, k)) add_residuals(blocks.residual(k), k);
    }
    return {};
  }

  // First sample of row j of block k in the region.
  int16_t* row_of(unsigned k, unsigned j) {
    const uint32_t x = (site_.bx + block_column(k) - rect_.bx0) * block_size_;
    const uint32_t y = (site_.by + block_row(k) - rect_.by0) * block_size_ + j;
    return samples_.samples.data() + size_t{y} * samples_.width + x;
  }

  Result<void> add_motion(const TileBlocks& blocks, unsigned k) {
    if (!reference_) {
      const ImagePos reference =
          sources_.stream.geometry.reference_of(site_.level, {site_.image_row, site_.image_col});
      auto opened = ReferenceReader::open(sources_, site_.level, reference, site_.plane);
      if (!opened) return tl::unexpected(opened.error());
      reference_ = std::make_unique<ReferenceReader>(std::move(*opened));
    }
    std::array<int16_t, size_t{kMaxBlockSize} * kMaxBlockSize> buffer;
    const auto size = static_cast<int32_t>(block_size_);
    const int32_t x = static_cast<int32_t>(site_.bx + block_column(k)) * size + blocks.dx[k];
    const int32_t y = static_cast<int32_t>(site_.by + block_row(k)) * size + blocks.dy[k];
    const auto view = reference_->view({x, y, block_size_, block_size_}, buffer.data());
    if (!view) return tl::unexpected(view.error());
    for (unsigned j = 0; j < block_size_; ++j) {
      int16_t* row = row_of(k, j);
      const int16_t* reference = view->data + j * view->stride;
      for (unsigned i = 0; i < block_size_; ++i) {
        const int32_t parent = keyed_ ? 0 : row[i];  // EXT-5
        row[i] =
            narrow<int16_t>(motion_prediction(parent, blocks.negative[k], reference[i], range_));
      }
    }
    return {};
  }

  void add_residuals(const int16_t* residual, unsigned k) {
    for (unsigned j = 0; j < block_size_; ++j) {
      int16_t* row = row_of(k, j);
      for (unsigned i = 0; i < block_size_; ++i) {
        row[i] = narrow<int16_t>(add_residual(row[i], *residual++, range_));
      }
    }
  }

  const FastSources& sources_;
  BlockSite site_;
  BlockRect rect_;
  SamplePlane& samples_;
  unsigned block_size_;
  bool keyed_;
  SampleRange range_;
  std::unique_ptr<ReferenceReader> reference_;
};

// The part of a key image in `rect`; samples outside the plane are 0.
void copy_key(const SamplePlane& key, const BlockRect& rect, unsigned block_size,
              SamplePlane& samples) {
  const uint32_t x0 = rect.bx0 * block_size;
  const uint32_t y0 = rect.by0 * block_size;
  copy_samples(key, x0, y0, std::min(samples.width, key.width - x0),
               std::min(samples.height, key.height - y0), samples);
}

}  // namespace

Result<void> add_level(const FastSources& sources, int level, ImagePos image, Plane plane,
                       const BlockRect& rect, std::span<SamplePlane> samples) {
  const Geometry& geometry = sources.stream.geometry;
  const bool is_key = geometry.is_key(level, image);
  if (sources.stream.header.has(Feature::kMotionTiles) && !geometry.is_reference(level, image)) {
    if (auto ok = add_motion(sources, level, image, plane, rect, samples); !ok) return ok;
  }
  for (size_t p = 0; p < samples.size(); ++p) {
    const auto at = static_cast<Plane>(static_cast<size_t>(plane) + p);
    if (!is_key) {
      if (auto ok = LevelPass(sources, level, image, at, rect, samples[p]).run(); !ok) return ok;
      continue;
    }
    const auto key = sources.key_plane(level, image, at);
    if (!key) return tl::unexpected(key.error());
    copy_key(**key, rect, geometry.block_size(), samples[p]);
  }
  return {};
}

Result<void> decode_region(const FastSources& sources, int level, ImagePos image, Plane plane,
                           const BlockRect& rect, std::span<SamplePlane> samples) {
  const Geometry& geometry = sources.stream.geometry;
  const unsigned size = geometry.block_size();
  for (SamplePlane& region : samples) {
    region = SamplePlane((rect.bx1 - rect.bx0) * size, (rect.by1 - rect.by0) * size);
  }
  for (int l = first_level(geometry, level, image); l >= level; --l) {
    const ImagePos at = geometry.ancestor(image, level, l);
    if (auto ok = add_level(sources, l, at, plane, rect, samples); !ok) return ok;
  }
  return {};
}

}  // namespace hmlfc
