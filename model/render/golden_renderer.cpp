// The golden renderer: docs/rendering.md as it reads.
#include <hmlfc/renderer.hpp>

#include "arithmetic/widths.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/displaced_cells.hpp"
#include "render/golden_blocks.hpp"
#include "render/shown_image.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

template <class Visit>
void for_each_pixel(const FrameRecord& record, const Visit& visit) {
  for (int32_t j = 0; j < record.frame_height; ++j) {
    for (int32_t i = 0; i < record.frame_width; ++i) visit(i, j);
  }
}

// Notes the blocks of all pixels, and counts.
void note_blocks(const FrameRecord& record, const CellDisplacements& displaced,
                 GoldenBlocks& blocks, uint64_t& interpolated, uint64_t& outside) {
  for_each_pixel(record, [&](int32_t i, int32_t j) {
    const auto ray = trace(record, i, j);
    outside += !ray;
    if (!ray) return;
    for_each_view_taps(record, *ray, displaced.at(i, j),
                       [&](const ViewTaps& taps) { interpolated += 3 * blocks.need(taps); });
  });
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
    GoldenBlocks blocks(decoder_, stop_level);
    uint64_t outside = 0;
    note_blocks(record, displaced, blocks, frame.counts.samples_interpolated, outside);
    if (auto ok = blocks.decode(); !ok) return ok;
    frame.counts.blocks_needed = blocks.count();
    frame.counts.blocks_decoded = blocks.count();
    draw(record, displaced, blocks, frame.image);
    return {};
  }

  void draw(const FrameRecord& record, const CellDisplacements& displaced,
            const GoldenBlocks& blocks, RgbImage& image) const {
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
        for_each_view_taps(record, *ray, displaced.at(i, j), [&](const ViewTaps& taps) {
          const Rgb q = blocks.colour(taps);
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

Result<FrameNeeds> frame_needs(const Decoder& decoder, const FrameRecord& record, int stop_level) {
  if (!fits(record, decoder.header(), stop_level)) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  return guard_request(DecoderAccess::stream(decoder).source, [&]() -> Result<FrameNeeds> {
    FrameNeeds needs;
    const CellDisplacements displaced = golden_displacements(decoder, record, stop_level);
    needs.disparities_looked_up = displaced.blocks_looked_up;
    GoldenBlocks blocks(decoder, stop_level);
    uint64_t interpolated = 0;
    note_blocks(record, displaced, blocks, interpolated, needs.pixels_outside);
    needs.blocks = blocks.list();
    return needs;
  });
}

}  // namespace hmlfc
