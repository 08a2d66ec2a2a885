// The decoded pixels of one view that the cache holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "render/block_bits.hpp"

namespace hmlfc {

/// Four samples a pixel: R, G, B and one without meaning; of one byte each at depth 8, of two
/// above.
inline constexpr uint32_t kPixelSamples = 4;

/// Rows of pixels that are held or dropped together; a multiple of the rows of two blocks.
inline constexpr uint32_t kPageRows = 64;

/// Sizes of the views of a light field, in pixels and blocks.
struct ViewShape {
  ViewShape(const StreamHeader& header, bool with_luma);

  uint32_t width = 0;
  uint32_t height = 0;
  int depth = 8;
  unsigned block_log2 = 2;
  unsigned chroma_shift = 0;  ///< 1 in format 4:2:0
  uint32_t blocks_x = 0;      ///< of Y
  uint32_t blocks_y = 0;
  uint32_t chroma_width = 0;
  uint32_t chroma_height = 0;
  uint32_t chroma_blocks_x = 0;
  uint32_t chroma_blocks_y = 0;
  uint32_t pages = 0;
  size_t sample_bytes = 1;
  bool keeps_luma = false;  ///< pages hold the samples of Y beside the pixels made of them

  /// Bytes of a row of pixels; one more than the width, which readers of pairs may load.
  size_t row_bytes() const { return (size_t{width} + 1) * kPixelSamples * sample_bytes; }
  /// Rows of blocks of Y, and of Co and Cg, in a page.
  uint32_t page_block_rows() const { return kPageRows >> block_log2; }
  uint32_t page_chroma_block_rows() const { return kPageRows >> (block_log2 + chroma_shift); }
  uint32_t page_chroma_rows() const { return kPageRows >> chroma_shift; }
};

/// kPageRows rows of one view: its pixels, and its samples of Co and Cg, of which further blocks of
/// Y may need some, and of Y where the shape keeps them.
struct ViewPage {
  explicit ViewPage(const ViewShape& shape);

  std::vector<uint8_t> pixels;
  std::array<std::vector<int16_t>, kPlaneCount> planes;  ///< samples by Plane

  std::vector<int16_t>& plane(Plane p) { return planes[static_cast<size_t>(p)]; }
  const std::vector<int16_t>& plane(Plane p) const { return planes[static_cast<size_t>(p)]; }

  /// Bytes that a page of this shape holds.
  static size_t bytes(const ViewShape& shape);
};

/// One view: which of its blocks the frame needs, which are there, and the pixels of these. A block
/// of Y stands for its pixels, which are there with it; Co and Cg have their blocks together.
class CachedView {
 public:
  CachedView(ViewPos place, const ViewShape& shape);

  ViewPos place() const { return place_; }

  BlockBits needed;         ///< blocks of Y that the frame needs
  BlockBits held;           ///< blocks of Y whose pixels are there
  BlockBits needed_chroma;  ///< blocks of Co, and of Cg, that the frame needs
  BlockBits held_chroma;

  /// Sets needed_chroma from needed (COL-3).
  void derive_chroma();

  /// Page `page`, made where it is not there.
  ViewPage& page(uint32_t page);
  const ViewPage& page(uint32_t page) const { return *pages_[page]; }  ///< it is there
  bool has_page(uint32_t page) const { return pages_[page] != nullptr; }
  bool has_pages() const;

  /// Drops page `page` and what is held in it.
  void drop_page(uint32_t page);

  /// Whether the frame needs a block in page `page`.
  bool needs_page(uint32_t page) const;

  /// Whether the frame needs a block in page `page` that is not held.
  bool misses_in_page(uint32_t page) const;

  /// The pixel rows of the view; null where their page is not there.
  const uint8_t* const* rows() const { return rows_.data(); }

  uint64_t frame = 0;                ///< the last frame that asked for the view
  std::vector<uint64_t> page_frame;  ///< the last frame that needed each page

 private:
  ViewPos place_;
  const ViewShape& shape_;
  std::vector<std::unique_ptr<ViewPage>> pages_;
  std::vector<const uint8_t*> rows_;
};

}  // namespace hmlfc
