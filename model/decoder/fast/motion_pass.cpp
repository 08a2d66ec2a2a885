#include "decoder/fast/region_decoder.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/block_motion.hpp"
#include "decoder/fast/interpolate.hpp"
#include "decoder/fast/motion_field.hpp"
#include "decoder/fast/reference_reader.hpp"

namespace hmlfc {
namespace {

// Samples predicted at once: a rectangle of at most this side.
constexpr uint32_t kPieceSide = 32;

// Samples [x0, x1) x [y0, y1) of a plane.
struct PixelBox {
  uint32_t x0, y0, x1, y1;
};

PixelBox common(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// The motion of a block, and which of K0 to K3 it reads.
struct ReadMotion {
  unsigned count = 0;  // of references
  bool negative = false;
  std::array<size_t, 2> images{};
  std::array<SubpelVector, 2> vectors{};
};

class MotionPass {
 public:
  MotionPass(const FastSources& sources, int level, ImagePos image, Plane plane,
             const BlockRect& rect, std::span<SamplePlane> samples)
      : sources_(sources),
        geometry_(sources.stream.geometry),
        level_(level),
        image_(image),
        plane_(plane),
        samples_(samples),
        resolver_(sources.stream, level, image, plane),
        range_(sample_range(plane, sources.stream.header.depth)),
        keyed_(geometry_.level(level).keyed) {
    const uint32_t size = geometry_.block_size();
    area_ = {rect.bx0 * size, rect.by0 * size, rect.bx1 * size, rect.by1 * size};
    motion_plane_ = geometry_.motion_plane_of(plane);
    shift_ = plane != Plane::kY && geometry_.motion_planes()[motion_plane_].halves ? 1 : 0;
  }

  Result<void> run() {
    const uint32_t side = (1u << sources_.stream.header.motion_tile_log2) >> shift_;
    const auto field = std::make_unique<MotionField>();
    for (uint32_t ty = area_.y0 / side; ty * side < area_.y1; ++ty) {
      for (uint32_t tx = area_.x0 / side; tx * side < area_.x1; ++tx) {
        const MotionTilePlace place{level_, image_, motion_plane_, tx, ty};
        if (auto ok = read_motion_field(sources_.stream, place, *field); !ok) return ok;
        const PixelBox tile{tx * side, ty * side, (tx + 1) * side, (ty + 1) * side};
        if (auto ok = add_tile(*field, tile); !ok) return ok;
      }
    }
    return {};
  }

 private:
  tl::unexpected<Error> failure(ErrorCode code) const { return fail(code, Section::kTile, 0); }

  // Side of the squares whose blocks all have their places in one square of 2^log2 samples of the
  // motion plane: that square, or one block where that is larger.
  uint32_t unit_side(unsigned log2) const {
    return std::max<uint32_t>(geometry_.block_size(), (1u << log2) >> shift_);
  }

  Result<void> add_tile(const MotionField& field, const PixelBox& tile) {
    const PixelBox wanted = common(tile, area_);
    const uint32_t unit = unit_side(field.head.block_log2);
    for (uint32_t y = wanted.y0 / unit * unit; y < wanted.y1; y += unit) {
      for (uint32_t x = wanted.x0 / unit * unit; x < wanted.x1; x += unit) {
        const uint32_t mx = ((x - tile.x0) << shift_) >> field.head.block_log2;
        const uint32_t my = ((y - tile.y0) << shift_) >> field.head.block_log2;
        const PaletteEntry* entry = field.entry(mx, my);
        if (entry == nullptr) return failure(ErrorCode::kBadMode);
        if (!entry->has_motion()) continue;
        const PixelBox part = common({x, y, x + unit, y + unit}, wanted);
        const auto added =
            entry->shares_disparity() ? add_shared(*entry, part) : add_own(*entry, part);
        if (!added) return added;
      }
    }
    return {};
  }

  // The part of a motion block whose vectors are the entry's own.
  Result<void> add_own(const PaletteEntry& entry, const PixelBox& part) {
    const auto motion = read_motion(entry, 0);
    if (!motion) return tl::unexpected(motion.error());
    return add_unit(*motion, part);
  }

  // The part of a motion block whose blocks take their disparities from the grid: neighbours in a
  // row with the same one are predicted together.
  Result<void> add_shared(const PaletteEntry& entry, const PixelBox& part) {
    if (!disparities_) {
      disparities_ = sources_.references.disparities(level_, resolver_.images()[0], motion_plane_);
    }
    const unsigned grid_log2 = sources_.stream.header.disparity_grid_log2;
    const MotionPlaneShape& plane = geometry_.motion_planes()[motion_plane_];
    const uint32_t unit = unit_side(grid_log2);
    const uint32_t left = part.x0 / unit * unit;
    const auto last = static_cast<int32_t>((plane.width - 1) >> grid_log2);
    for (uint32_t y = part.y0 / unit * unit; y < part.y1; y += unit) {
      const auto block_at = [&](uint32_t x) {
        return grid_block(x << shift_, y << shift_, entry.choice, grid_log2, plane);
      };
      const GridBlock first = block_at(left);
      const int16_t* row =
          disparities_->row(first.gx, block_at((part.x1 - 1) / unit * unit).gx, first.gy);
      auto column =
          static_cast<int32_t>((left << shift_) >> grid_log2) + kChoiceMoves[entry.choice][0];
      for (uint32_t x = left; x < part.x1;) {
        const int16_t shared = row[clamp(column, 0, last)];
        uint32_t end = x;
        do {
          end += unit;
          column += static_cast<int32_t>((unit << shift_) >> grid_log2);
        } while (end < part.x1 && row[clamp(column, 0, last)] == shared);
        if (shared == DisparityPlane::kDamaged) return failure(ErrorCode::kVectorRange);
        const auto motion = shared_motion(entry, shared);
        if (!motion) return tl::unexpected(motion.error());
        if (auto ok = add_unit(**motion, common({x, y, end, y + unit}, part)); !ok) return ok;
        x = end;
      }
    }
    return {};
  }

  // The motion of an entry that shares `disparity`, cached for the latest disparities.
  Result<const ReadMotion*> shared_motion(const PaletteEntry& entry, int16_t disparity) {
    const auto bits = static_cast<uint16_t>(disparity);
    const uint32_t key =
        bits | uint32_t{entry.reference_set} << 16 | uint32_t{entry.negative} << 24;
    CachedMotion& slot = cached_[(bits + uint32_t{entry.reference_set} * 86) % cached_.size()];
    if (slot.key != key) {
      const auto motion = read_motion(entry, disparity);
      if (!motion) return tl::unexpected(motion.error());
      slot = {key, *motion};
    }
    return &slot.motion;
  }

  Result<ReadMotion> read_motion(const PaletteEntry& entry, int32_t disparity) {
    const BlockMotion resolved = resolver_.resolve(entry, disparity);
    ReadMotion motion{resolved.count, resolved.negative, {}, {}};
    for (unsigned i = 0; i < resolved.count; ++i) {
      const auto image = open_readers(resolved.references[i].image);
      if (!image) return tl::unexpected(image.error());
      motion.images[i] = *image;
      motion.vectors[i] = resolved.references[i].vector;
    }
    return motion;
  }

  Result<void> add_unit(const ReadMotion& motion, const PixelBox& unit) {
    for (uint32_t y = unit.y0; y < unit.y1; y += kPieceSide) {
      for (uint32_t x = unit.x0; x < unit.x1; x += kPieceSide) {
        const PixelBox piece = common({x, y, x + kPieceSide, y + kPieceSide}, unit);
        if (auto ok = add_piece(motion, piece); !ok) return ok;
      }
    }
    return {};
  }

  Result<void> add_piece(const ReadMotion& motion, const PixelBox& piece) {
    constexpr size_t kBuffer = size_t{kPieceSide + 1} * (kPieceSide + 1);
    std::array<std::array<int16_t, kBuffer>, 2> buffers;
    std::array<ReferenceArea, 2> areas;
    std::array<DisplacedReference, 2> references;
    const unsigned columns = piece.x1 - piece.x0;
    const unsigned rows = piece.y1 - piece.y0;
    for (unsigned i = 0; i < motion.count; ++i) {
      const SubpelVector& vector = motion.vectors[i];
      areas[i] = {static_cast<int32_t>(piece.x0) + vector.ix,
                  static_cast<int32_t>(piece.y0) + vector.iy, columns + (vector.fx == 0 ? 0 : 1),
                  rows + (vector.fy == 0 ? 0 : 1)};
    }
    for (size_t p = 0; p < samples_.size(); ++p) {
      for (unsigned i = 0; i < motion.count; ++i) {
        const auto view = readers_[motion.images[i]][p].view(areas[i], buffers[i].data());
        if (!view) return tl::unexpected(view.error());
        references[i] = {*view, motion.vectors[i].fx, motion.vectors[i].fy};
      }
      const size_t stride = samples_[p].width;
      int16_t* out = samples_[p].samples.data() + size_t{piece.y0 - area_.y0} * stride;
      put_piece(references, motion, {out + (piece.x0 - area_.x0), stride, columns, rows});
    }
    return {};
  }

  // At a keyed level A is R: it is a mean of samples in [lo, hi], which the clamp leaves alone, and
  // its sign is + (EXT-5, MOT-3).
  void put_piece(const std::array<DisplacedReference, 2>& references, const ReadMotion& motion,
                 const PredictionTarget& out) const {
    if (keyed_) return interpolate_rect(references, motion.count, range_.hi, out);
    std::array<int16_t, size_t{kPieceSide} * kPieceSide> reference;
    interpolate_rect(references, motion.count, range_.bound,
                     {reference.data(), out.columns, out.columns, out.rows});
    const int16_t* from = reference.data();
    for (unsigned y = 0; y < out.rows; ++y, from += out.columns) {
      int16_t* row = out.data + y * out.stride;
      for (unsigned x = 0; x < out.columns; ++x) {
        row[x] = narrow<int16_t>(motion_prediction(row[x], motion.negative, from[x], range_));
      }
    }
  }

  // Which of K0 to K3 `image` is; its planes can be read afterwards.
  Result<size_t> open_readers(ImagePos image) {
    const auto& images = resolver_.images();
    const auto i = static_cast<size_t>(std::ranges::find(images, image) - images.begin());
    if (i == images.size()) return failure(ErrorCode::kBadMode);
    while (readers_[i].size() < samples_.size()) {
      const auto plane = static_cast<Plane>(static_cast<size_t>(plane_) + readers_[i].size());
      auto opened = ReferenceReader::open(sources_, level_, image, plane);
      if (!opened) return tl::unexpected(opened.error());
      readers_[i].push_back(std::move(*opened));
    }
    return i;
  }

  struct CachedMotion {
    uint32_t key = UINT32_MAX;  // no motion has it
    ReadMotion motion;
  };

  const FastSources& sources_;
  const Geometry& geometry_;
  int level_;
  ImagePos image_;
  Plane plane_;
  std::span<SamplePlane> samples_;  // of plane_ and the planes after it
  MotionResolver resolver_;
  SampleRange range_;
  bool keyed_;
  PixelBox area_{};
  size_t motion_plane_ = 0;
  unsigned shift_ = 0;  // 1: the motion plane has twice the width and height
  std::array<std::vector<ReferenceReader>, 4> readers_;  // of K0 to K3, by plane
  std::shared_ptr<const DisparityPlane> disparities_;
  std::array<CachedMotion, 256> cached_;
};

}  // namespace

Result<void> add_motion(const FastSources& sources, int level, ImagePos image, Plane plane,
                        const BlockRect& rect, std::span<SamplePlane> samples) {
  return MotionPass(sources, level, image, plane, rect, samples).run();
}

}  // namespace hmlfc
