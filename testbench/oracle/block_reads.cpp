#include "oracle/block_reads.hpp"

#include <algorithm>

#include "decoder/golden/block_decoder.hpp"
#include "decoder/golden/block_walk.hpp"
#include "oracle/oracle.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kLeastRead = 16;  // bytes of each read of the index

class ReadList final : public ReadSink {
 public:
  explicit ReadList(std::vector<ByteRange>& ranges) : ranges_(ranges) {}

  void on_read(uint64_t offset, uint64_t bytes) override {
    ranges_.push_back({false, offset, offset + std::max(bytes, kLeastRead)});
  }

 private:
  std::vector<ByteRange>& ranges_;
};

// The block in which sample `at` lies, or the border's for one outside a plane of `size` samples.
uint32_t block_at(int32_t at, uint32_t size, unsigned block_size) {
  return static_cast<uint32_t>(std::clamp(at, 0, static_cast<int32_t>(size) - 1)) / block_size;
}

}  // namespace

BlockReads::BlockReads(const GoldenStream& stream) : stream_(stream) {
  for (const AreaPlane& plane : area_layout(stream.geometry()).planes) {
    images_.try_emplace({plane.level, plane.image.row, plane.image.col}, plane.offset);
  }
}

std::vector<ByteRange> BlockReads::of(const Request& request) const {
  std::vector<ByteRange> ranges;
  if (!request_exists(stream_, request)) return ranges;
  if (request.plane != kRgb) {
    add_plane(request, static_cast<Plane>(request.plane), ranges);
    return ranges;
  }
  const ChromaFormat format = stream_.header().chroma_format;
  Request chroma = request;
  chroma.bx = chroma_block(request.bx, format);
  chroma.by = chroma_block(request.by, format);
  add_plane(request, Plane::kY, ranges);
  add_plane(chroma, Plane::kCo, ranges);
  add_plane(chroma, Plane::kCg, ranges);
  return ranges;
}

void BlockReads::add_plane(const Request& request, Plane plane,
                           std::vector<ByteRange>& ranges) const {
  const Geometry& geometry = stream_.geometry();
  const int stop = static_cast<int>(request.stop_level);
  const ImagePos own = geometry.ancestor({request.row, request.col}, 0, stop);
  if (request.residuals) {
    ReadList reads(ranges);
    StreamView view = stream_.view();
    view.reads = &reads;
    const BlockSite site{stop, own.row, own.col, plane, request.bx, request.by};
    static_cast<void>(walk_to_block(view, Probe{nullptr, nullptr, site}));
    return;
  }
  for (int l = first_level(geometry, stop, own); l >= stop; --l) {
    const ImagePos image = geometry.ancestor(own, stop, l);
    if (!add_level({l, image.row, image.col, plane, request.bx, request.by}, ranges)) return;
  }
}

// Whether the block's records decode.
bool BlockReads::add_level(const BlockSite& site, std::vector<ByteRange>& ranges) const {
  const Geometry& geometry = stream_.geometry();
  const ImagePos image{site.image_row, site.image_col};
  if (geometry.is_key(site.level, image)) {
    add_strips(site, site.bx, site.by, ranges);
    return true;
  }
  ReadList reads(ranges);
  StreamView view = stream_.view();
  view.reads = &reads;
  const Probe probe{nullptr, nullptr, site};
  const bool motion_tiles = stream_.header().has(Feature::kMotionTiles);
  BlockMotion motion;
  if (motion_tiles && !geometry.is_reference(site.level, image)) {
    const auto read = walk_to_motion(view, probe);
    if (!read) return false;
    motion = *read;
  }
  const auto block = walk_to_block(view, probe);
  if (!block) return false;
  if (!motion_tiles && block->entry.has_motion()) {
    motion.count = 1;
    motion.references[0] = {geometry.reference_of(site.level, image),
                            {block->entry.dx, block->entry.dy, 0, 0}};
  }
  for (unsigned i = 0; i < motion.count; ++i) add_window(site, motion.references[i], ranges);
  return true;
}

// The strips of the displaced block, with a column and a row more where it lies between samples.
void BlockReads::add_window(const BlockSite& site, const ReferenceMotion& motion,
                            std::vector<ByteRange>& ranges) const {
  const PlaneShape& shape = stream_.geometry().plane(site.plane);
  const unsigned size = stream_.geometry().block_size();
  const SubpelVector& vector = motion.vector;
  const int32_t x = static_cast<int32_t>(site.bx * size) + vector.ix;
  const int32_t y = static_cast<int32_t>(site.by * size) + vector.iy;
  const auto side = static_cast<int32_t>(size);
  BlockSite first = site;
  first.image_row = motion.image.row;
  first.image_col = motion.image.col;
  first.bx = block_at(x, shape.width, size);
  first.by = block_at(y, shape.height, size);
  add_strips(first, block_at(x + side - (vector.fx == 0 ? 1 : 0), shape.width, size),
             block_at(y + side - (vector.fy == 0 ? 1 : 0), shape.height, size), ranges);
}

// Those with the blocks from `site` to (last_bx, last_by) of a reference image.
void BlockReads::add_strips(const BlockSite& site, uint32_t last_bx, uint32_t last_by,
                            std::vector<ByteRange>& ranges) const {
  const Geometry& geometry = stream_.geometry();
  const unsigned size = geometry.block_size();
  const uint32_t blocks = kStripSamples / (size * size);
  uint64_t plane = images_.at({site.level, site.image_row, site.image_col});
  for (const Plane p : kPlanes) {
    if (p == site.plane) break;
    const PlaneShape& before = geometry.plane(p);
    plane += uint64_t{strips_in_row(before.width, size)} * before.blocks_y * kStripBytes;
  }
  const uint64_t row = uint64_t{strips_in_row(geometry.plane(site.plane).width, size)};
  for (uint32_t by = site.by; by <= last_by; ++by) {
    for (uint32_t strip = site.bx / blocks; strip <= last_bx / blocks; ++strip) {
      const uint64_t begin = plane + (row * by + strip) * kStripBytes;
      ranges.push_back({true, begin, begin + kStripBytes});
    }
  }
}

}  // namespace hmlfc::tb
