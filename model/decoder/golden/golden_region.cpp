#include "decoder/golden/golden_region.hpp"

#include "arithmetic/narrow.hpp"

namespace hmlfc {

Result<SamplePlane> decode_region_by_blocks(const DecodeSources& sources, int level, ImagePos image,
                                            Plane plane, const BlockRect& rect) {
  const unsigned size = sources.stream.geometry.block_size();
  SamplePlane samples((rect.bx1 - rect.bx0) * size, (rect.by1 - rect.by0) * size);
  for (uint32_t by = rect.by0; by < rect.by1; ++by) {
    for (uint32_t bx = rect.bx0; bx < rect.bx1; ++bx) {
      const BlockSite site{level, image.row, image.col, plane, bx, by};
      const auto block = decode_block(sources, site, Probe{});
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
