#include "render/frame_stages.hpp"

#include <algorithm>
#include <vector>

#include "decoder/colour_row.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc {
namespace {

bool has_all(const BlockBits& held, const BlockRect& rect) {
  for (uint32_t by = rect.by0; by < rect.by1; ++by) {
    if (!held.has_range(rect.bx0, rect.bx1, by)) return false;
  }
  return true;
}

// Rectangles that cover exactly the blocks of rows [first, last) that are needed and not held: runs
// of a row joined with the same runs in the rows below.
std::vector<BlockRect> missing_rects(const BlockBits& needed, const BlockBits& held, uint32_t first,
                                     uint32_t last) {
  std::vector<BlockRect> rects;
  size_t open = 0;  // rects[open...] end at the row above
  for (uint32_t by = first; by < last; ++by) {
    std::vector<BlockRect> row;
    needed.for_each_run_without(held, by, [&](uint32_t begin, uint32_t end) {
      row.push_back({begin, by, end, by + 1});
    });
    const size_t end_open = rects.size();
    size_t next_open = end_open;
    for (const BlockRect& run : row) {
      const auto above = std::find_if(
          rects.begin() + static_cast<ptrdiff_t>(open),
          rects.begin() + static_cast<ptrdiff_t>(end_open), [&](const BlockRect& rect) {
            return rect.bx0 == run.bx0 && rect.bx1 == run.bx1 && rect.by1 == by;
          });
      if (above != rects.begin() + static_cast<ptrdiff_t>(end_open)) {
        above->by1 = by + 1;
        next_open = std::min(next_open, static_cast<size_t>(above - rects.begin()));
      } else {
        rects.push_back(run);
      }
    }
    open = next_open;
  }
  return rects;
}

std::vector<BlockRect> missing_luma(const ViewShape& shape, const CachedView& view, uint32_t page) {
  const uint32_t rows = shape.page_block_rows();
  return missing_rects(view.needed, view.held, page * rows,
                       std::min((page + 1) * rows, shape.blocks_y));
}

std::vector<BlockRect> missing_chroma(const ViewShape& shape, const CachedView& view,
                                      uint32_t page) {
  const uint32_t rows = shape.page_chroma_block_rows();
  return missing_rects(view.needed_chroma, view.held_chroma, page * rows,
                       std::min((page + 1) * rows, shape.chroma_blocks_y));
}

class PageLoader {
 public:
  PageLoader(const Decoder& decoder, const ViewShape& shape, int stop_level,
             const CachedView* coarser, CachedView& view, uint32_t page, KeyRequests* requests)
      : decoder_(decoder),
        shape_(shape),
        stop_level_(stop_level),
        coarser_(coarser),
        view_(view),
        number_(page),
        page_(view.page(page)),
        requests_(requests) {}

  Result<void> run() {
    const auto chroma = missing_chroma(shape_, view_, number_);
    for (const BlockRect& rect : chroma) {
      if (auto ok = load_chroma(rect); !ok) return ok;
    }
    const auto luma = missing_luma(shape_, view_, number_);
    for (const BlockRect& rect : luma) {
      if (auto ok = load_luma(rect); !ok) return ok;
    }
    if (has_requests()) return {};
    for (const BlockRect& rect : chroma) hold(rect, view_.held_chroma);
    for (const BlockRect& rect : luma) hold(rect, view_.held);
    return {};
  }

 private:
  // Whether samples have no meaning.
  bool has_requests() const { return requests_ != nullptr && !requests_->empty(); }

  // The samples of `blocks` that lie in a plane of this size.
  Rect samples_of(const BlockRect& blocks, uint32_t width, uint32_t height) const {
    const unsigned log2 = shape_.block_log2;
    const uint32_t x = blocks.bx0 << log2;
    const uint32_t y = blocks.by0 << log2;
    return {x, y, std::min(blocks.bx1 << log2, width) - x,
            std::min(blocks.by1 << log2, height) - y};
  }

  // Offset of row j of `rect` in a plane of the page.
  size_t offset_in_page(Plane plane, const Rect& rect, uint32_t j) const {
    const bool luma = plane == Plane::kY;
    const uint32_t top = number_ * (luma ? kPageRows : shape_.page_chroma_rows());
    return size_t{rect.y - top + j} * (luma ? shape_.width : shape_.chroma_width) + rect.x;
  }

  // The samples of `blocks`, which cover `rect`: refined from the coarser level where it holds all
  // of them, else decoded from the top.
  Result<std::vector<int16_t>> decode(Plane plane, const BlockRect& blocks, const Rect& rect) {
    const bool luma = plane == Plane::kY;
    if (coarser_ != nullptr && has_all(luma ? coarser_->held : coarser_->held_chroma, blocks)) {
      const std::vector<int16_t>& parent = coarser_->page(number_).plane(plane);
      std::vector<int16_t> samples(size_t{rect.width} * rect.height);
      for (uint32_t j = 0; j < rect.height; ++j) {
        std::copy_n(parent.data() + offset_in_page(plane, rect, j), rect.width,
                    samples.data() + size_t{j} * rect.width);
      }
      if (decoder_.refine_rect(view_.place(), plane, rect, stop_level_, samples)) return samples;
    }
    return DecoderAccess::decode_rect(decoder_, view_.place(), plane, rect, stop_level_, requests_);
  }

  void keep(Plane plane, const Rect& rect, const std::vector<int16_t>& samples) {
    for (uint32_t j = 0; j < rect.height; ++j) {
      std::copy_n(samples.data() + size_t{j} * rect.width, rect.width,
                  page_.plane(plane).data() + offset_in_page(plane, rect, j));
    }
  }

  Result<void> load_chroma(const BlockRect& blocks) {
    const Rect rect = samples_of(blocks, shape_.chroma_width, shape_.chroma_height);
    for (const Plane plane : {Plane::kCo, Plane::kCg}) {
      const auto samples = decode(plane, blocks, rect);
      if (!samples) return tl::unexpected(samples.error());
      keep(plane, rect, *samples);
    }
    return {};
  }

  Result<void> load_luma(const BlockRect& blocks) {
    const Rect rect = samples_of(blocks, shape_.width, shape_.height);
    const auto samples = decode(Plane::kY, blocks, rect);
    if (!samples) return tl::unexpected(samples.error());
    if (has_requests()) return {};
    if (shape_.keeps_luma) keep(Plane::kY, rect, *samples);
    for (uint32_t j = 0; j < rect.height; ++j) {
      write_pixels(rect, rect.y + j, samples->data() + size_t{j} * rect.width);
    }
    return {};
  }

  // Writes the pixels of row `y` of the view in `rect`, whose samples of Y are `luma`.
  void write_pixels(const Rect& rect, uint32_t y, const int16_t* luma) {
    const unsigned shift = shape_.chroma_shift;
    const uint32_t in_page = y - number_ * kPageRows;
    const size_t chroma = size_t{in_page >> shift} * shape_.chroma_width + (rect.x >> shift);
    const ColourRow row{luma,
                        page_.plane(Plane::kCo).data() + chroma,
                        page_.plane(Plane::kCg).data() + chroma,
                        rect.width,
                        shift != 0,
                        shape_.depth};
    uint8_t* out = page_.pixels.data() + in_page * shape_.row_bytes() +
                   size_t{rect.x} * kPixelSamples * shape_.sample_bytes;
    if (shape_.sample_bytes == 1) {
      write_rgbx(row, out);
    } else {
      write_rgbx(row, reinterpret_cast<uint16_t*>(out));
    }
  }

  static void hold(const BlockRect& rect, BlockBits& held) {
    for (uint32_t by = rect.by0; by < rect.by1; ++by) {
      held.set_range(rect.bx0, rect.bx1, by);
    }
  }

  const Decoder& decoder_;
  const ViewShape& shape_;
  int stop_level_;
  const CachedView* coarser_;
  CachedView& view_;
  uint32_t number_;
  ViewPage& page_;
  KeyRequests* requests_;
};

}  // namespace

void add_missing_parts(const StreamView& stream, const ViewShape& shape, int stop_level,
                       const CachedView& view, uint32_t page, std::vector<ImagePart>& parts) {
  const ImagePos image =
      stream.geometry.ancestor({view.place().row, view.place().col}, 0, stop_level);
  for (const BlockRect& rect : missing_luma(shape, view, page)) {
    parts.push_back({stop_level, image, Plane::kY, rect});
  }
  for (const BlockRect& rect : missing_chroma(shape, view, page)) {
    for (const Plane plane : {Plane::kCo, Plane::kCg}) {
      parts.push_back({stop_level, image, plane, rect});
    }
  }
}

Result<void> load_page(const Decoder& decoder, const ViewShape& shape, int stop_level,
                       const CachedView* coarser, CachedView& view, uint32_t page,
                       KeyRequests* requests) {
  return PageLoader(decoder, shape, stop_level, coarser, view, page, requests).run();
}

}  // namespace hmlfc
