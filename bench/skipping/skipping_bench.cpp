// What frames and single blocks need of a stream, and what is skipped
// (bench/skipping/__main__.py runs it).
//
// Usage: bench_skipping frames FILE.hmlfc PATH FRAMES SIDE cold|warm
//          draws FRAMES square frames along PATH: orbit, line, dolly (forwards from the middle of
//          the grid) or view (the middle view). cold: each frame with a new decoder and renderer;
//          warm: all with the same.
//        bench_skipping block FILE.hmlfc RUNS
//          decodes the middle block of Y of the middle view with a decoder of its own, RUNS times.
// Both run on one thread and print JSON. `ranges` are the bytes read of the file, [offset, length],
// ascending and merged where they touch, without those of opening the stream.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/renderer.hpp>

#include "io/mapped_file.hpp"
#include "render/frame_stages.hpp"
#include "render/orbit.hpp"
#include "render/timing.hpp"
#include "render/view_cache.hpp"

namespace {

using namespace hmlfc;

constexpr int kUsage = 2;

int refuse(const std::string& message, int status = 1) {
  fmt::print(stderr, "bench_skipping: {}\n", message);
  return status;
}

// The bytes that one thread reads, as disjoint ranges.
class Ranges final : public ReadSink {
 public:
  void on_read(uint64_t offset, uint64_t bytes) override {
    if (bytes == 0) return;
    uint64_t begin = offset;
    uint64_t end = offset + bytes;
    auto next = ends_.lower_bound(begin);  // the first range that does not begin before this one
    if (next != ends_.begin() && std::prev(next)->second >= begin) --next;
    while (next != ends_.end() && next->first <= end) {
      begin = std::min(begin, next->first);
      end = std::max(end, next->second);
      next = ends_.erase(next);
    }
    ends_.emplace(begin, end);
  }

  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  void reset() {
    ends_.clear();
    key_samples_ = 0;
  }

  std::string json() const {
    std::string text;
    for (const auto& [begin, end] : ends_) {
      text += fmt::format("{}[{},{}]", text.empty() ? "" : ",", begin, end - begin);
    }
    return fmt::format("\"key_samples\":{},\"ranges\":[{}]", key_samples_, text);
  }

 private:
  std::map<uint64_t, uint64_t> ends_;  // of ranges by their begin
  uint64_t key_samples_ = 0;
};

// Finds out from the stages of a block whether its entry adds anything to its parent (TIL-5).
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
Result<NeededBlocks> needed_blocks(const Decoder& decoder, const FrameRecord& record) {
  ViewCache cache(decoder.header(), 0, false);
  cache.begin_frame();
  plan_frame(record, 0, decoder.header(), cache);
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
          if (const auto ok = decoder.decode_block(block, {.trace = &stages}); !ok) {
            return tl::unexpected(ok.error());
          }
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

OpenOptions reading(Ranges& ranges) {
  OpenOptions options;
  options.check_sections = false;
  options.reads = &ranges;
  return options;
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

int draw_frames(const std::vector<std::string>& arguments) {
  const auto file = io::MappedFile::open(arguments[1]);
  if (!file) return refuse(file.error().message);
  const std::string& path = arguments[2];
  const int frames = std::atoi(arguments[3].c_str());
  const auto side = static_cast<uint32_t>(std::atoi(arguments[4].c_str()));
  const bool warm = arguments[5] == "warm";
  OpenOptions unchecked;
  unchecked.check_sections = false;
  const auto golden = Decoder::open(file->bytes(), unchecked);
  if (!golden) return refuse(to_string(golden.error()));
  Ranges ranges;
  std::unique_ptr<Client> client;
  for (int k = 0; k < frames; ++k) {
    const auto record =
        frame_record(camera_of(path, golden->header(), k, frames, side), golden->header());
    if (!record) return refuse(record.error().message);
    const auto needed = needed_blocks(*golden, *record);
    if (!needed) return refuse(to_string(needed.error()));
    if (!client || !warm) {
      auto decoder = Decoder::open(file->bytes(), reading(ranges));
      if (!decoder) return refuse(to_string(decoder.error()));
      client = std::make_unique<Client>(std::move(*decoder));
    }
    ranges.reset();
    Frame frame;
    const bench::Clock clock;
    const auto drawn = client->renderer->render(*record, 0, frame);
    const double seconds = clock.cpu_seconds();
    if (!drawn) return refuse(to_string(drawn.error()));
    if (frame.counts.blocks_needed != needed->all) return refuse("the planner counts differ");
    fmt::print(
        "{}{{\"views\":{},\"needed\":{},\"decoded\":{},\"reused\":{},\"zero\":{},"
        "\"cpu_seconds\":{:.6g},{}}}",
        k == 0 ? "[" : ",\n", needed->views, needed->all, frame.counts.blocks_decoded,
        frame.counts.blocks_reused, needed->zero, seconds, ranges.json());
  }
  fmt::print("]\n");
  return 0;
}

int decode_block(const std::vector<std::string>& arguments) {
  const auto file = io::MappedFile::open(arguments[1]);
  if (!file) return refuse(file.error().message);
  const int runs = std::atoi(arguments[2].c_str());
  if (runs < 1) return refuse("RUNS is not a number from 1 on", kUsage);
  Ranges ranges;
  double opening = 1e9;
  double decoding = 1e9;
  AccessCounts counts;
  for (int run = 0; run < runs; ++run) {
    const bench::Clock clock;
    const auto decoder = Decoder::open(file->bytes(), reading(ranges));
    if (!decoder) return refuse(to_string(decoder.error()));
    opening = std::min(opening, clock.cpu_seconds());
    ranges.reset();
    counts = {};
    const StreamHeader& header = decoder->header();
    const BlockAddress middle{{header.rows / 2u, header.cols / 2u},
                              Plane::kY,
                              header.width / 2 / header.block_size(),
                              header.height / 2 / header.block_size()};
    const bench::Clock block_clock;
    const auto samples = decoder->decode_block(middle, {.counts = &counts});
    decoding = std::min(decoding, block_clock.cpu_seconds());
    if (!samples) return refuse(to_string(samples.error()));
  }
  fmt::print(
      "{{\"open_cpu_seconds\":{:.6g},\"cpu_seconds\":{:.6g},\"walks\":{},\"fields\":{},{}}}\n",
      opening, decoding, counts.walks, counts.fields, ranges.json());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 6 && arguments[0] == "frames") return draw_frames(arguments);
  if (arguments.size() == 3 && arguments[0] == "block") return decode_block(arguments);
  return refuse("usage: frames FILE PATH FRAMES SIDE cold|warm, or block FILE RUNS", kUsage);
}
