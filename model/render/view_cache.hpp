// The decoded views that frames read, kept between frames within a budget of bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

#include <hmlfc/format.hpp>

#include "render/block_bits.hpp"
#include "render/shown_image.hpp"

namespace hmlfc {

/// Samples of a pixel in memory: R, G, B and one without meaning; one byte each at depth 8, else
/// two.
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
  bool keeps_luma = false;  ///< pages hold the samples of Y besides the pixels

  /// Bytes of a row of width + 1 pixels: kernels load pairs of pixels.
  size_t row_bytes() const { return (size_t{width} + 1) * kPixelSamples * sample_bytes; }
  /// Rows of blocks of Y, and of Co and Cg, in a page.
  uint32_t page_block_rows() const { return kPageRows >> block_log2; }
  uint32_t page_chroma_block_rows() const { return kPageRows >> (block_log2 + chroma_shift); }
  uint32_t page_chroma_rows() const { return kPageRows >> chroma_shift; }
};

/// kPageRows rows of one view: its pixels, its samples of Co and Cg, which pixels of further blocks
/// of Y may need, and those of Y where the shape keeps them.
struct ViewPage {
  explicit ViewPage(const ViewShape& shape);

  std::vector<uint8_t> pixels;
  std::array<std::vector<int16_t>, kPlaneCount> planes;  ///< samples by Plane

  std::vector<int16_t>& plane(Plane p) { return planes[static_cast<size_t>(p)]; }
  const std::vector<int16_t>& plane(Plane p) const { return planes[static_cast<size_t>(p)]; }

  /// Bytes of a page of this shape.
  static size_t bytes(const ViewShape& shape);
};

/// The decoded pixels of one view: which of its blocks the frame needs, which are held, and their
/// pixels. A block of Y stands for its pixels; Co and Cg share their sets of blocks.
class CachedView {
 public:
  /// `missing_row` stands for the rows of pages that do not exist.
  CachedView(ViewPos place, const ViewShape& shape, const uint8_t* missing_row);

  ViewPos place() const { return place_; }

  BlockBits needed;         ///< blocks of Y that the frame needs
  BlockBits held;           ///< blocks of Y whose pixels are held
  BlockBits needed_chroma;  ///< blocks of Co and of Cg that the frame needs
  BlockBits held_chroma;    ///< blocks of Co and of Cg whose samples are held

  /// Sets needed_chroma from needed (COL-3).
  void derive_chroma();

  /// Page `page`, created if missing.
  ViewPage& page(uint32_t page);
  const ViewPage& page(uint32_t page) const { return *pages_[page]; }  ///< it exists
  bool has_page(uint32_t page) const { return pages_[page] != nullptr; }
  bool has_pages() const;

  /// Drops page `page` and what is held in it.
  void drop_page(uint32_t page);

  /// Whether the frame needs a block in page `page`.
  bool needs_page(uint32_t page) const;

  /// Whether the frame needs a block in page `page` that is not held.
  bool misses_in_page(uint32_t page) const;

  /// The pixel rows of the view and one after the last: where their page does not exist, and after
  /// the last, a row whose pixels have no meaning, so that kernels may load what has weight 0.
  const uint8_t* const* rows() const { return rows_.data(); }

  uint64_t frame = 0;                ///< the last frame that used the view
  std::vector<uint64_t> page_frame;  ///< the last frame that needed each page

 private:
  ViewPos place_;
  const ViewShape& shape_;
  std::vector<std::unique_ptr<ViewPage>> pages_;
  const uint8_t* missing_row_;
  std::vector<const uint8_t*> rows_;
};

/// Decoded views of one light field by stop level and place. A full budget drops the pages needed
/// longest ago first; those of the current frame stay.
class ViewCache {
 public:
  ViewCache(const StreamHeader& header, size_t budget, bool keeps_luma)
      : shape_(header, keeps_luma), budget_(budget), missing_row_(shape_.row_bytes()) {}

  const ViewShape& shape() const { return shape_; }

  /// Begins a frame, which needs nothing yet.
  void begin_frame();

  /// The view at `place`, created if missing; the frame uses it. Several threads may call this at
  /// once.
  CachedView& use(ViewPos place, int stop_level);

  /// The view at `place` if there is one; not while another thread calls use().
  const CachedView* find(ViewPos place, int stop_level) const;

  /// The views that the frame uses, by stop level and place.
  std::vector<CachedView*> used();

  /// Marks the pages that the frame needs and drops others, so that those still to be created fit
  /// in the budget if possible.
  void make_room();

  /// Ends a frame: where its pages exceed the budget, drops them too.
  void end_frame();

  /// Bytes of all pages.
  size_t bytes() const;

 private:
  struct PlacedPage {
    uint64_t frame;
    CachedView* view;
    uint32_t page;
  };

  static uint64_t key_of(ViewPos place, int stop_level) {
    return (static_cast<uint64_t>(stop_level) << 32 | place.row) << 16 | place.col;
  }

  void drop_oldest(size_t wanted_bytes, bool also_of_this_frame);

  const ViewShape shape_;
  size_t budget_;
  const std::vector<uint8_t> missing_row_;
  uint64_t frame_ = 0;
  std::shared_mutex mutex_;
  std::unordered_map<uint64_t, std::unique_ptr<CachedView>> views_;
};

/// The cached views of one frame by their place in the grid, for one thread: keeps the last
/// lookups, since those in the cache take a lock.
class ViewLookup {
 public:
  ViewLookup(ViewCache& cache, const StreamHeader& header, int stop_level)
      : cache_(cache), header_(header), stop_level_(stop_level) {}

  CachedView& at(int32_t row, int32_t col) {
    Entry& entry = entries_[static_cast<size_t>((row * 16 + col) & (kEntries - 1))];
    if (entry.view == nullptr || entry.row != row || entry.col != col) {
      const ViewPos place{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
      entry = {row, col, &cache_.use(first_view_of(header_, place, stop_level_), stop_level_)};
    }
    return *entry.view;
  }

 private:
  static constexpr int32_t kEntries = 256;

  struct Entry {
    int32_t row = 0;
    int32_t col = 0;
    CachedView* view = nullptr;
  };

  ViewCache& cache_;
  const StreamHeader& header_;
  int stop_level_;
  std::array<Entry, kEntries> entries_;
};

}  // namespace hmlfc
