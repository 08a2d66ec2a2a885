// The golden renderer: docs/rendering.md as it reads.
#include <hmlfc/renderer.hpp>

#include <map>
#include <set>
#include <tuple>

#include "arithmetic/colour.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/displaced_cells.hpp"
#include "render/shown_image.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

// The order of NED-2: views row by row, planes, blocks row by row.
struct BlockOrder {
  bool operator()(const BlockAddress& a, const BlockAddress& b) const {
    return std::tie(a.view.row, a.view.col, a.plane, a.by, a.bx) <
           std::tie(b.view.row, b.view.col, b.plane, b.by, b.bx);
  }
};

using BlockSet = std::set<BlockAddress, BlockOrder>;

// The block of `plane` that holds the sample of pixel (x, y) of a view (COL-3, STR-6).
BlockAddress block_of(const StreamHeader& header, ViewPos view, Plane plane, uint32_t x,
                      uint32_t y) {
  const bool halved = plane != Plane::kY && header.chroma_format == ChromaFormat::k420;
  const unsigned shift = header.block_log2 + (halved ? 1 : 0);
  return {view, plane, x >> shift, y >> shift};
}

// The decoded blocks of a frame, read as pixels of views.
class Blocks {
 public:
  Blocks(const Decoder& decoder, int stop_level) : decoder_(decoder), stop_level_(stop_level) {}

  // Decodes `needed` in its order (NED-2).
  Result<void> decode(const BlockSet& needed) {
    for (const BlockAddress& block : needed) {
      auto samples = decoder_.decode_block(block, {.stop_level = stop_level_});
      if (!samples) return tl::unexpected(samples.error());
      blocks_.emplace(block, std::move(*samples));
    }
    return {};
  }

  // A pixel whose blocks are decoded (COL-2, COL-3).
  Rgb pixel(ViewPos view, int32_t x, int32_t y) const {
    return inverse_colour({sample(view, Plane::kY, x, y), sample(view, Plane::kCo, x, y),
                           sample(view, Plane::kCg, x, y)},
                          depth());
  }

  int depth() const { return decoder_.header().depth; }

 private:
  int32_t sample(ViewPos view, Plane plane, int32_t x, int32_t y) const {
    const StreamHeader& header = decoder_.header();
    const bool halved = plane != Plane::kY && header.chroma_format == ChromaFormat::k420;
    const auto px = static_cast<uint32_t>(x);
    const auto py = static_cast<uint32_t>(y);
    const uint32_t side = header.block_size();
    const uint32_t column = (px >> (halved ? 1 : 0)) % side;
    const uint32_t row = (py >> (halved ? 1 : 0)) % side;
    return blocks_.at(block_of(header, view, plane, px, py))[row * side + column];
  }

  const Decoder& decoder_;
  int stop_level_;
  std::map<BlockAddress, std::vector<int32_t>, BlockOrder> blocks_;
};

// q of SMP-2 of one view.
Rgb view_colour(const Blocks& blocks, const ViewTaps& taps) {
  const auto at = [&](int32_t x, int32_t y) { return blocks.pixel(taps.view, x, y); };
  const Rgb p00 = at(taps.x.first, taps.y.first);
  const Rgb p10 = at(taps.x.last(), taps.y.first);
  const Rgb p01 = at(taps.x.first, taps.y.last());
  const Rgb p11 = at(taps.x.last(), taps.y.last());
  const int depth = blocks.depth();
  return {interpolate_pixels(taps.x, taps.y, p00.r, p10.r, p01.r, p11.r, depth),
          interpolate_pixels(taps.x, taps.y, p00.g, p10.g, p01.g, p11.g, depth),
          interpolate_pixels(taps.x, taps.y, p00.b, p10.b, p01.b, p11.b, depth)};
}

class GoldenRenderer final : public FrameRenderer {
 public:
  explicit GoldenRenderer(const Decoder& decoder) : decoder_(decoder) {}

  Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) override {
    if (!fits(record, decoder_.header(), stop_level)) {
      return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
    }
    return guard_request(DecoderAccess::stream(decoder_).source,
                         [&] { return render_checked(record, stop_level, frame); });
  }

 private:
  Result<void> render_checked(const FrameRecord& record, int stop_level, Frame& frame) const {
    frame.seconds = {};
    frame.counts = {};
    const CellDisplacements displaced = golden_displacements(decoder_, record, stop_level);
    frame.counts.disparities_looked_up = displaced.blocks_looked_up;
    const BlockSet needed = needed_blocks(record, stop_level, displaced, frame.counts);
    Blocks blocks(decoder_, stop_level);
    if (auto ok = blocks.decode(needed); !ok) return ok;
    frame.counts.blocks_needed = needed.size();
    frame.counts.blocks_decoded = needed.size();
    draw(record, stop_level, displaced, blocks, frame.image);
    return {};
  }

  ViewPos shown(ViewPos view, int stop_level) const {
    return first_view_of(decoder_.header(), view, stop_level);
  }

  template <class Visit>
  void for_each_pixel(const FrameRecord& record, const Visit& visit) const {
    for (int32_t j = 0; j < record.frame_height; ++j) {
      for (int32_t i = 0; i < record.frame_width; ++i) visit(i, j);
    }
  }

  BlockSet needed_blocks(const FrameRecord& record, int stop_level,
                         const CellDisplacements& displaced, FrameCounts& counts) const {
    const StreamHeader& header = decoder_.header();
    BlockSet needed;
    for_each_pixel(record, [&](int32_t i, int32_t j) {
      const auto ray = trace(record, i, j);
      if (!ray) return;
      for_each_view_taps(record, *ray, displaced.at(i, j), [&](const ViewTaps& taps) {
        for (int32_t y = taps.y.first; y <= taps.y.last(); ++y) {
          for (int32_t x = taps.x.first; x <= taps.x.last(); ++x) {
            counts.samples_interpolated += 3;
            for (const Plane plane : kPlanes) {
              needed.insert(block_of(header, shown(taps.view, stop_level), plane,
                                     static_cast<uint32_t>(x), static_cast<uint32_t>(y)));
            }
          }
        }
      });
    });
    return needed;
  }

  void draw(const FrameRecord& record, int stop_level, const CellDisplacements& displaced,
            const Blocks& blocks, RgbImage& image) const {
    image = {static_cast<uint32_t>(record.frame_width),
             static_cast<uint32_t>(record.frame_height),
             decoder_.header().depth,
             {}};
    for_each_pixel(record, [&](int32_t i, int32_t j) {
      uint32_t r = 0;
      uint32_t g = 0;
      uint32_t b = 0;
      const auto ray = trace(record, i, j);
      if (ray) {
        for_each_view_taps(record, *ray, displaced.at(i, j), [&](ViewTaps taps) {
          taps.view = shown(taps.view, stop_level);
          const Rgb q = view_colour(blocks, taps);
          r += taps.weight * static_cast<uint32_t>(q.r);
          g += taps.weight * static_cast<uint32_t>(q.g);
          b += taps.weight * static_cast<uint32_t>(q.b);
        });
      }
      for (const uint32_t sum : {r, g, b}) {
        // 0 outside (RAY-6)
        image.samples.push_back(narrow<uint16_t>(frame_sample(sum, image.depth)));
      }
    });
  }

  const Decoder& decoder_;
};

}  // namespace

std::unique_ptr<FrameRenderer> make_golden_renderer(const Decoder& decoder) {
  return std::make_unique<GoldenRenderer>(decoder);
}

}  // namespace hmlfc
