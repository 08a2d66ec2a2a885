// What frames and single blocks need of a stream, and what is skipped
// (bench/skipping/__main__.py runs it).
//
// Usage: bench_skipping frames FILE.hmlfc PATH FRAMES SIDE cold|warm plane|stream
//          draws FRAMES square frames along PATH: orbit, line, dolly (forwards from the middle of
//          the grid) or view (the middle view). cold: each frame with a new decoder and renderer;
//          warm: all with the same. plane, stream: as --geometry of `hmlfc render`.
//        bench_skipping block FILE.hmlfc RUNS
//          decodes the middle block of Y of the middle view RUNS times, each with a new decoder.
// Both run on one thread and print JSON. `reads` are the distinct reads of the file, [offset,
// length], without those of opening the stream.
#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/renderer.hpp>

#include "common/orbit.hpp"
#include "common/program.hpp"
#include "io/files.hpp"
#include "render/frame_stages.hpp"
#include "render/golden_displacements.hpp"
#include "render/view_cache.hpp"
#include "terminal/clock.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;
using Json = nlohmann::ordered_json;

// What one thread reads.
class Reads final : public ReadSink {
 public:
  void on_read(uint64_t offset, uint64_t bytes) override {
    if (bytes > 0) reads_.insert({offset, bytes});
  }

  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  void reset() {
    reads_.clear();
    key_samples_ = 0;
  }

  void add_to(Json& row) const {
    row["key_samples"] = key_samples_;
    row["reads"] = reads_;
  }

 private:
  std::set<std::array<uint64_t, 2>> reads_;
  uint64_t key_samples_ = 0;
};

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

// The blocks that a frame needs (NED-1), and those of them in state zero.
NeededBlocks needed_blocks(const Decoder& decoder, const FrameRecord& record) {
  ViewCache cache(decoder.header(), 0, false);
  cache.begin_frame();
  plan_frame(record, 0, decoder.header(), golden_displacements(decoder, record, 0), cache);
  NeededBlocks counts;
  for (CachedView* view : cache.used()) {
    view->derive_chroma();
    ++counts.views;
    for (const Plane plane : kPlanes) {
      const BlockBits& needed = plane == Plane::kY ? view->needed : view->needed_chroma;
      const uint32_t side = decoder.header().block_size();
      const PlaneSize size = decoder.plane_size(plane);
      for (uint32_t by = 0; by < (size.height + side - 1) / side; ++by) {
        for (uint32_t bx = 0; bx < (size.width + side - 1) / side; ++bx) {
          if (!needed.has(bx, by)) continue;
          const BlockAddress block{view->place(), plane, bx, by};
          EntryStages stages(block);
          value_of(decoder.decode_block(block, {.trace = &stages}));
          ++counts.all;
          counts.zero += stages.zero() ? 1u : 0u;
        }
      }
    }
  }
  return counts;
}

Camera camera_of(const std::string& path, const StreamHeader& header, int frame, int frames,
                 uint32_t side) {
  Camera camera = bench::orbit_camera(header, frame, frames, side);
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

Decoder open(const MappedFile& file, Reads* reads = nullptr) {
  OpenOptions options;
  options.check_sections = false;
  options.reads = reads;
  return value_of(Decoder::open(file.bytes(), options));
}

// A decoder with its renderer.
struct Client {
  explicit Client(Decoder opened) : decoder(std::move(opened)) {
    RenderOptions options;
    options.threads = 1;
    renderer = make_cpu_renderer(decoder, options);
  }
  Decoder decoder;
  std::unique_ptr<FrameRenderer> renderer;
};

Json draw_frames(const std::vector<std::string>& arguments) {
  const auto file = value_of(io::map_file(arguments[1]));
  const int frames = std::stoi(arguments[3]);
  const auto side = static_cast<uint32_t>(std::stoi(arguments[4]));
  const bool warm = arguments[5] == "warm";
  const bool geometry = arguments[6] == "stream";
  const Decoder golden = open(file);
  const StreamHeader& header = golden.header();
  Reads reads;
  std::unique_ptr<Client> client;
  Json rows = Json::array();
  for (int k = 0; k < frames; ++k) {
    Camera camera = camera_of(arguments[2], header, k, frames, side);
    camera.geometry = geometry ? GeometrySource::kStream : GeometrySource::kPlane;
    const FrameRecord record = value_of(frame_record(camera, header));
    const NeededBlocks needed = needed_blocks(golden, record);
    if (!client || !warm) client = std::make_unique<Client>(open(file, &reads));
    reads.reset();
    Frame frame;
    const Clock clock;
    const auto drawn = client->renderer->render(record, 0, frame);
    const double seconds = clock.cpu_seconds();
    value_of(drawn);
    if (frame.counts.blocks_needed != needed.all) {
      throw std::runtime_error("the planner counts differ");
    }
    rows.push_back({{"views", needed.views},
                    {"needed", needed.all},
                    {"decoded", frame.counts.blocks_decoded},
                    {"reused", frame.counts.blocks_reused},
                    {"zero", needed.zero},
                    {"cpu_seconds", seconds}});
    if (geometry) rows.back()["looked_up"] = frame.counts.disparities_looked_up;
    reads.add_to(rows.back());
  }
  return rows;
}

Json decode_block(const std::vector<std::string>& arguments) {
  const auto file = value_of(io::map_file(arguments[1]));
  Reads reads;
  double opening = 1e9;
  double decoding = 1e9;
  AccessCounts counts;
  for (int run = 0; run < std::max(std::stoi(arguments[2]), 1); ++run) {
    const Clock clock;
    const Decoder decoder = open(file, &reads);
    opening = std::min(opening, clock.cpu_seconds());
    reads.reset();
    counts = {};
    const StreamHeader& header = decoder.header();
    const BlockAddress middle{{header.rows / 2u, header.cols / 2u},
                              Plane::kY,
                              header.width / 2 / header.block_size(),
                              header.height / 2 / header.block_size()};
    const Clock block_clock;
    const auto samples = decoder.decode_block(middle, {.counts = &counts});
    decoding = std::min(decoding, block_clock.cpu_seconds());
    value_of(samples);
  }
  Json row{{"open_cpu_seconds", opening},
           {"cpu_seconds", decoding},
           {"walks", counts.walks},
           {"fields", counts.fields}};
  reads.add_to(row);
  return row;
}

int run(const std::vector<std::string>& arguments) {
  Json made;
  if (arguments.size() == 7 && arguments[0] == "frames") {
    made = draw_frames(arguments);
  } else if (arguments.size() == 3 && arguments[0] == "block") {
    made = decode_block(arguments);
  } else {
    throw std::invalid_argument(
        "usage: frames FILE PATH FRAMES SIDE cold|warm plane|stream, or block FILE RUNS");
  }
  fmt::print("{}\n", made.dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_skipping", [&] { return run({argv + 1, argv + argc}); });
}
