// What frames and single blocks need of a stream, and what is skipped. All on one thread.
#include <algorithm>
#include <memory>

#include <hmlfc/renderer.hpp>

#include "common/measuring.hpp"
#include "render/displaced_cells.hpp"
#include "render/frame_stages.hpp"
#include "render/view_cache.hpp"
#include "subcommands.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

// Whether the entry of one block adds anything to its parent (TIL-5): its own stages tell.
class EntryStages final : public TraceSink {
 public:
  explicit EntryStages(const BlockAddress& block) : block_(block) {}
  void on_field(const FieldRecord&) override {}
  void on_stage(const StageRecord& record) override {
    const BlockSite& site = record.site;
    if (site.level != 0 || site.image_row != block_.view.row || site.image_col != block_.view.col ||
        site.plane != block_.plane || site.bx != block_.bx || site.by != block_.by) {
      return;
    }
    predicted_ |= record.stage == "parent";
    coded_ |= record.stage == "reference" || record.stage == "residual";
  }

  bool zero() const { return predicted_ && !coded_; }

 private:
  BlockAddress block_;
  bool predicted_ = false;  // not of a key image
  bool coded_ = false;
};

struct NeededBlocks {
  uint64_t views = 0;
  uint64_t all = 0;
  uint64_t zero = 0;
};

// Adds the needed blocks of a plane, and those of them in state zero.
void add_blocks(const Decoder& decoder, const CachedView& view, Plane plane, NeededBlocks& counts) {
  const BlockBits& needed = plane == Plane::kY ? view.needed : view.needed_chroma;
  const uint32_t side = decoder.header().block_size();
  const PlaneSize size = decoder.plane_size(plane);
  for (uint32_t by = 0; by < (size.height + side - 1) / side; ++by) {
    for (uint32_t bx = 0; bx < (size.width + side - 1) / side; ++bx) {
      if (!needed.has(bx, by)) continue;
      const BlockAddress block{view.place(), plane, bx, by};
      EntryStages stages(block);
      value_of(decoder.decode_block(block, {.trace = &stages}));
      ++counts.all;
      counts.zero += stages.zero() ? 1u : 0u;
    }
  }
}

// The blocks that a frame needs (NED-1).
NeededBlocks needed_blocks(const Decoder& decoder, const FrameRecord& record) {
  ViewCache cache(decoder.header(), 0, false);
  cache.begin_frame();
  plan_frame(record, 0, decoder.header(), golden_displacements(decoder, record, 0), cache);
  NeededBlocks counts;
  for (CachedView* view : cache.used()) {
    view->derive_chroma();
    ++counts.views;
    for (const Plane plane : kPlanes) add_blocks(decoder, *view, plane, counts);
  }
  return counts;
}

Camera camera_of(const std::string& path, const StreamHeader& header, int frame, int frames,
                 uint32_t side) {
  Camera camera = orbit_camera(header, frame, frames, side);
  const double part = frames == 1 ? 0.5 : static_cast<double>(frame) / (frames - 1);
  if (path == "view") {
    camera.position = WorldPoint{header.cols / 2 * 1.0, header.rows / 2 * 1.0, 0};
  } else if (path == "line") {
    camera.position = WorldPoint{(header.cols - 1) * part, (header.rows - 1) * 0.5, 0};
  } else if (path == "dolly") {
    camera.position =
        WorldPoint{(header.cols - 1) * 0.5, (header.rows - 1) * 0.5, header.cols * part};
  }
  return camera;
}

// A decoder with its renderer, and what they read.
struct Client {
  explicit Client(std::span<const uint8_t> file) : decoder(open_unchecked(file, &reads)) {
    RenderOptions options;
    options.threads = 1;
    renderer = make_cpu_renderer(decoder, options);
  }
  Reads reads;
  Decoder decoder;
  std::unique_ptr<FrameRenderer> renderer;
};

Json drawn(Client& client, const FrameRecord& record, const NeededBlocks& needed) {
  client.reads.forget_ranges();
  const uint64_t key_samples = client.reads.key_samples();
  Frame frame;
  const Clock clock;
  const auto drawn = client.renderer->render(record, 0, frame);
  const double seconds = clock.cpu_seconds();
  value_of(drawn);
  if (frame.counts.blocks_needed != needed.all)
    throw std::runtime_error("the planner counts differ");
  return {{"views", needed.views},
          {"needed", needed.all},
          {"decoded", frame.counts.blocks_decoded},
          {"reused", frame.counts.blocks_reused},
          {"zero", needed.zero},
          {"cpu_seconds", seconds},
          {"looked_up", frame.counts.disparities_looked_up},
          {"key_samples", client.reads.key_samples() - key_samples},
          {"reads", client.reads.ranges()}};
}

}  // namespace

Json path(Arguments arguments) {
  const auto file = value_of(io::map_file(arguments[0]));
  const int frames = std::stoi(arguments[2]);
  const auto side = static_cast<uint32_t>(std::stoi(arguments[3]));
  const Decoder golden = open_unchecked(file.bytes());
  std::unique_ptr<Client> client;
  Json rows = Json::array();
  for (int k = 0; k < frames; ++k) {
    Camera camera = camera_of(arguments[1], golden.header(), k, frames, side);
    if (arguments[5] == "stream") camera.geometry = GeometrySource::kStream;
    const FrameRecord record = value_of(frame_record(camera, golden.header()));
    if (!client || arguments[4] != "warm") client = std::make_unique<Client>(file.bytes());
    rows.push_back(drawn(*client, record, needed_blocks(golden, record)));
  }
  return rows;
}

Json block(Arguments arguments) {
  const auto file = value_of(io::map_file(arguments[0]));
  double opening = 1e9;
  double decoding = 1e9;
  Json row;
  for (int run = 0; run < std::max(std::stoi(arguments[1]), 1); ++run) {
    Reads reads;
    const Clock clock;
    const Decoder decoder = open_unchecked(file.bytes(), &reads);
    opening = std::min(opening, clock.cpu_seconds());
    reads.forget_ranges();
    const StreamHeader& header = decoder.header();
    const BlockAddress middle{{header.rows / 2u, header.cols / 2u},
                              Plane::kY,
                              header.width / 2 / header.block_size(),
                              header.height / 2 / header.block_size()};
    AccessCounts counts;
    const Clock block_clock;
    const auto samples = decoder.decode_block(middle, {.counts = &counts});
    decoding = std::min(decoding, block_clock.cpu_seconds());
    value_of(samples);
    row = {{"walks", counts.walks}, {"fields", counts.fields}, {"reads", reads.ranges()}};
  }
  row["open_cpu_seconds"] = opening;
  row["cpu_seconds"] = decoding;
  return row;
}

}  // namespace hmlfc::bench
