#include "gpu/cache_model.hpp"

#include <algorithm>
#include <iterator>

#include "render/taps.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kBlocksOfPage = 32;

uint64_t page_bytes(const StreamHeader& header) {
  return kBlocksOfPage * header.block_size() * header.block_size() * sizeof(int16_t);
}

std::set<uint64_t> without(const std::set<uint64_t>& all, const std::set<uint64_t>& taken) {
  std::set<uint64_t> rest;
  std::ranges::set_difference(all, taken, std::inserter(rest, rest.end()));
  return rest;
}

std::set<uint64_t> pages_of(const std::set<uint64_t>& blocks) {
  std::set<uint64_t> pages;
  for (const uint64_t block : blocks) pages.insert(block / kBlocksOfPage);
  return pages;
}

}  // namespace

CacheModel::CacheModel(const StreamView& stream, uint64_t budget)
    : header_(stream.header),
      geometry_(stream.geometry),
      kept_pages_(budget / page_bytes(stream.header)) {}

uint64_t CacheModel::take(const FrameRecord& record, int stop_level,
                          const CellDisplacements& displaced) {
  if (stop_level != stop_level_) forget();
  stop_level_ = stop_level;
  const Blocks needed = needed_blocks(record, displaced);
  Blocks missing = without(needed, held_);
  uint64_t new_pages = without(pages_of(missing), pages_of(held_)).size();
  if (used_pages_ + new_pages > kept_pages_) {
    forget();
    missing = needed;
    new_pages = pages_of(needed).size();
  }
  held_.insert(missing.begin(), missing.end());
  used_pages_ += new_pages;
  return missing.size();
}

CacheModel::Blocks CacheModel::needed_blocks(const FrameRecord& record,
                                             const CellDisplacements& displaced) const {
  Blocks needed;
  for (int32_t j = 0; j < record.frame_height; ++j) {
    for (int32_t i = 0; i < record.frame_width; ++i) {
      const auto ray = trace(record, i, j);
      if (!ray) continue;
      for_each_view_taps(record, *ray, displaced.at(i, j), [&](const ViewTaps& taps) {
        const ImagePos image = geometry_.ancestor({taps.view.row, taps.view.col}, 0, stop_level_);
        for (int32_t y = taps.y.first; y <= taps.y.last(); ++y) {
          for (int32_t x = taps.x.first; x <= taps.x.last(); ++x) {
            for (const Plane plane : kPlanes) needed.insert(block_number(image, plane, x, y));
          }
        }
      });
    }
  }
  return needed;
}

uint64_t CacheModel::block_number(ImagePos image, Plane plane, int32_t x, int32_t y) const {
  const auto blocks = [&](Plane p) {
    return uint64_t{geometry_.plane(p).blocks_x} * geometry_.plane(p).blocks_y;
  };
  uint64_t number = uint64_t{image.row} * geometry_.level(stop_level_).cols + image.col;
  number *= blocks(Plane::kY) + blocks(Plane::kCo) + blocks(Plane::kCg);
  if (plane != Plane::kY) number += blocks(Plane::kY);
  if (plane == Plane::kCg) number += blocks(Plane::kCo);
  const bool halved = plane != Plane::kY && header_.chroma_format == ChromaFormat::k420;
  const unsigned shift = header_.block_log2 + (halved ? 1u : 0u);
  return number + uint64_t{static_cast<uint32_t>(y) >> shift} * geometry_.plane(plane).blocks_x +
         (static_cast<uint32_t>(x) >> shift);
}

}  // namespace hmlfc::gpu
