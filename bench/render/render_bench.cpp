// Time of a frame of novel-view rendering, of the first one, and of decoding one view beside other
// codecs.
//
// Usage: ./run bench render [FILE.hmlfc [FOLDER]]
// FILE: a stream; default: Chess of HMLFC_DATA_DIR, or of ../shared/data if that is not set,
// encoded in profile extended at quality 64. FOLDER: the views it was made from. CPU times are
// those of all threads, of single views the shortest of many runs; frames/s depend on what else the
// machine runs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/encoder.hpp>
#include <hmlfc/renderer.hpp>

#include "common/orbit.hpp"
#include "common/program.hpp"
#include "common/timing.hpp"
#include "io/data_folder.hpp"
#include "io/files.hpp"
#include "io/light_field_files.hpp"
#include "render/peers.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;

constexpr int kFrames = 60;
constexpr int kFirstFrames = 10;

struct Setting {
  std::string name;
  Filter filter = Filter::kQuadrilinear;
  int aperture = 0;
  bool turned = false;
  size_t cache_bytes = size_t{256} << 20;
  GeometrySource geometry = GeometrySource::kPlane;
};

FrameRecord record_of(const Setting& setting, const StreamHeader& header, int frame) {
  Camera camera = bench::orbit_camera(header, frame, kFrames, 512);
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
  const Setting settings[] = {{"quadrilinear"},
                              {"quadrilinear, nothing kept", Filter::kQuadrilinear, 0, false, 0},
                              {"quadrilinear, turned", Filter::kQuadrilinear, 0, true},
                              {"quadrilinear, geometry", Filter::kQuadrilinear, 0, false,
                               size_t{256} << 20, GeometrySource::kStream},
                              {"quadrilinear, aperture 1", Filter::kQuadrilinear, 1},
                              {"bilinear", Filter::kBilinear},
                              {"nearest", Filter::kNearest}};
  for (const Setting& setting : settings) {
    // A decoder of its own: key images are decoded again.
    const Decoder decoder = value_of(Decoder::open(file, {false, {}, nullptr}));
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
      const Decoder decoder = value_of(Decoder::open(file, {false, {}, nullptr}));
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

void print_peer(const std::string& name, double seconds, double own, double psnr) {
  fmt::print("| {} | {:.3f} | {:.2f} | {} |\n", name, seconds * 1e3, seconds / own,
             std::isfinite(psnr) ? fmt::format("{:.2f} dB", psnr) : "");
  std::fflush(stdout);
}

// Decoding one view, on one thread, beside other codecs.
void print_view(std::span<const uint8_t> file, const LightField& field) {
  const Decoder decoder = value_of(Decoder::open(file));
  const StreamHeader& header = decoder.header();
  const ViewPos view{header.rows / 2 - 1, header.cols / 2 - 2};  // no key image
  const RgbImage original = field.view(view.row, view.col);
  const RgbImage decoded = value_of(decoder.decode_view(view));
  const auto psnr_of = [&](const RgbImage& image) {
    return psnr(measure(original, image).rgb_squares, original.samples.size(), original.depth);
  };
  const double own_psnr = psnr_of(decoded);
  const double own = bench::cpu_seconds_of([&] { (void)decoder.decode_view(view); });
  fmt::print(
      "\n| one view of {} x {}, one thread | CPU ms | times | PSNR RGB |\n|---|---|---|---|\n",
      header.width, header.height);
  print_peer("HMLFC", own, own, own_psnr);
  RgbImage copy = decoded;
  const double copying = bench::cpu_seconds_of(
      [&] { std::copy(decoded.samples.begin(), decoded.samples.end(), copy.samples.begin()); });
  print_peer("memcpy of its output", copying, own, INFINITY);
  for (const auto& peer : {bench::openjpeg_peer(original, own_psnr), bench::astc_peer(original)}) {
    if (!peer) throw std::runtime_error("another codec fails");
    print_peer(peer->name, peer->seconds, own, psnr_of(peer->decoded));
  }
}

std::vector<uint8_t> encoded_chess(const LightField& field) {
  EncodeParams params;
  params.extended.quality = 64;
  return value_of(encode(field, params)).bytes;
}

int run(const std::vector<std::string>& arguments) {
  const auto folder = arguments.size() > 1 ? std::filesystem::path(arguments[1])
                                           : data_folder("stanford-chess-16x16-700x400");
  const auto views = value_of(io::list_views(folder));
  const LightField field = value_of(io::load_light_field(views, 0));
  std::vector<uint8_t> file;
  if (arguments.empty()) {
    file = encoded_chess(field);
  } else {
    const auto mapped = value_of(io::map_file(arguments[0]));
    file.assign(mapped.bytes().begin(), mapped.bytes().end());
  }
  print_frames(file);
  print_first_frames(file);
  print_view(file, field);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_render", [&] { return run({argv + 1, argv + argc}); });
}
