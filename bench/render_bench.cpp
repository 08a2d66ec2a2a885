// Time of a frame of novel-view rendering, and of the first one after opening.
//
// Usage: ./run bench render [FILE.hmlfc]
// FILE: a stream; default: Chess of HMLFC_DATA_DIR, or of ../shared/data if that is not set,
// encoded in profile extended at quality 64. CPU times are those of all threads; frames/s depend on
// what else the machine runs.
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/renderer.hpp>

#include "common/measuring.hpp"
#include "io/data_folder.hpp"
#include "io/light_field_files.hpp"
#include "subcommands.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

constexpr int kFrames = 60;
constexpr int kFirstFrames = 10;
constexpr size_t kCacheBytes = size_t{256} << 20;

struct Setting {
  const char* name = "";
  Filter filter = Filter::kQuadrilinear;
  int aperture = 0;
  bool turned = false;
  size_t cache_bytes = kCacheBytes;
  GeometrySource geometry = GeometrySource::kPlane;
};

constexpr Setting kSettings[] = {{"quadrilinear"},
                                 {"quadrilinear, nothing kept", Filter::kQuadrilinear, 0, false, 0},
                                 {"quadrilinear, turned", Filter::kQuadrilinear, 0, true},
                                 {"quadrilinear, geometry", Filter::kQuadrilinear, 0, false,
                                  kCacheBytes, GeometrySource::kStream},
                                 {"quadrilinear, aperture 1", Filter::kQuadrilinear, 1},
                                 {"views", Filter::kViews},
                                 {"nearest", Filter::kNearest}};

FrameRecord record_of(const Setting& setting, const StreamHeader& header, int frame) {
  Camera camera = orbit_camera(header, frame, kFrames, 512);
  camera.filter = setting.filter;
  camera.aperture = setting.aperture;
  camera.geometry = setting.geometry;
  if (setting.turned) {
    camera.position->z = -1;
    camera.look_at = WorldPoint{camera.position->u + 0.1, camera.position->v + 0.05, 0};
  }
  return *frame_record(camera, header);
}

// One turn of the orbit; a row of the table.
void print_turn(const Setting& setting, const char* state, const Decoder& decoder,
                FrameRenderer& renderer) {
  FrameSeconds seconds;
  FrameCounts counts;
  Frame frame;
  const Clock clock;
  for (int k = 0; k < kFrames; ++k) {
    value_of(renderer.render(record_of(setting, decoder.header(), k), 0, frame));
    seconds.plan += frame.seconds.plan;
    seconds.decode += frame.seconds.decode;
    seconds.sample += frame.seconds.sample;
    counts.blocks_needed += frame.counts.blocks_needed;
    counts.blocks_decoded += frame.counts.blocks_decoded;
  }
  const double share = 100 / seconds.total();
  fmt::print("| {} | {} | {:.0f} | {:.2f} | {:.0f} % | {:.0f} % | {:.0f} % | {} | {} |\n",
             setting.name, state, kFrames / clock.wall_seconds(),
             clock.cpu_seconds() / kFrames * 1e3, seconds.plan * share, seconds.decode * share,
             seconds.sample * share, counts.blocks_needed / kFrames,
             counts.blocks_decoded / kFrames);
  std::fflush(stdout);
}

void print_frames(std::span<const uint8_t> file) {
  fmt::print(
      "| 512x512, orbit of {} frames | cache | frames/s | CPU ms a frame | plan | decode | sample "
      "| blocks needed | decoded |\n|---|---|---|---|---|---|---|---|---|\n",
      kFrames);
  for (const Setting& setting : kSettings) {
    const Decoder decoder = open_unchecked(file);  // one of its own: key images are decoded again
    RenderOptions options;
    options.cache_bytes = setting.cache_bytes;
    const auto renderer = make_cpu_renderer(decoder, options);
    print_turn(setting, "cold", decoder, *renderer);
    print_turn(setting, "warm", decoder, *renderer);
  }
}

// The first frame of a decoder and renderer that are new: the shortest wall-clock time of
// kFirstFrames, and its CPU time.
void print_first_frames(std::span<const uint8_t> file) {
  fmt::print("\n| first frame after opening | wall-clock ms | CPU ms |\n|---|---|---|\n");
  for (const int threads : {1, 2}) {
    double wall = INFINITY;
    double cpu = 0;
    for (int run = 0; run < kFirstFrames; ++run) {
      const Decoder decoder = open_unchecked(file);
      RenderOptions options;
      options.threads = threads;
      const auto renderer = make_cpu_renderer(decoder, options);
      const FrameRecord record = record_of({}, decoder.header(), 0);
      Frame frame;
      const Clock clock;
      value_of(renderer->render(record, 0, frame));
      if (clock.wall_seconds() >= wall) continue;
      wall = clock.wall_seconds();
      cpu = clock.cpu_seconds();
    }
    fmt::print("| {} thread{} | {:.1f} | {:.1f} |\n", threads, threads == 1 ? "" : "s", wall * 1e3,
               cpu * 1e3);
  }
}

std::vector<uint8_t> encoded_chess() {
  const auto views = value_of(io::list_views(data_folder("stanford-chess-16x16-700x400")));
  EncodeParams params;
  params.extended.quality = 64;
  return value_of(encode(value_of(io::load_light_field(views, 0)), params)).bytes;
}

void print_tables(std::span<const uint8_t> file) {
  print_frames(file);
  print_first_frames(file);
}

}  // namespace

void render(Arguments arguments) {
  if (arguments.empty()) {
    print_tables(encoded_chess());
  } else {
    print_tables(value_of(io::map_file(arguments[0])).bytes());
  }
}

}  // namespace hmlfc::bench
