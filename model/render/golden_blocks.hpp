// The blocks that a frame needs, decoded one after the other and read as pixels of views (NED-1,
// NED-2).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "arithmetic/colour.hpp"
#include "render/taps.hpp"

namespace hmlfc {

/// The order of NED-2: images row by row, planes, blocks row by row. An image stands here as the
/// first view that shows it.
struct BlockOrder {
  /// Whether `a` comes before `b`.
  bool operator()(const BlockAddress& a, const BlockAddress& b) const;
};

/// The blocks of one frame: first every need(), then decode(), then the pixels.
class GoldenBlocks {
 public:
  /// Views are decoded down to `stop_level` (DEC-1). `decoder` must outlive this.
  GoldenBlocks(const Decoder& decoder, int stop_level)
      : decoder_(decoder), stop_level_(stop_level) {}

  /// Notes the blocks of the pixels that `taps` reads (SMP-2); returns how many pixels these are.
  uint64_t need(const ViewTaps& taps);

  /// The blocks noted.
  uint64_t count() const { return blocks_.size(); }

  /// The same in the order of NED-2.
  std::vector<BlockAddress> list() const;

  /// Decodes them in the order of NED-2. Errors: that of the first which has one.
  Result<void> decode();

  /// Pixel (`x`, `y`) of `view`, whose blocks are decoded (COL-2, COL-3).
  Rgb pixel(ViewPos view, int32_t x, int32_t y) const;

  /// q of SMP-2 for R, G and B of one view.
  Rgb colour(const ViewTaps& taps) const;

 private:
  BlockAddress block_of(ViewPos view, Plane plane, int32_t x, int32_t y) const;
  int32_t sample(ViewPos view, Plane plane, int32_t x, int32_t y) const;

  const Decoder& decoder_;
  int stop_level_;
  std::map<BlockAddress, std::vector<int32_t>, BlockOrder> blocks_;
};

}  // namespace hmlfc
