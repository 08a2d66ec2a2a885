// Time of a frame of novel-view rendering, and of decoding one view beside other codecs.
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

#include "common/data_folder.hpp"
#include "io/light_field_files.hpp"
#include "io/mapped_file.hpp"
#include "render/orbit.hpp"
#include "render/peers.hpp"
#include "render/timing.hpp"

namespace {

using namespace hmlfc;

constexpr int kFrames = 60;

struct Setting {
  std::string name;
  Filter filter = Filter::kQuadrilinear;
  int aperture = 0;
  bool turned = false;
  size_t cache_bytes = size_t{256} << 20;
};

FrameRecord record_of(const Setting& setting, const StreamHeader& header, int frame) {
  Camera camera = bench::orbit_camera(header, frame, kFrames, 512);
  camera.filter = setting.filter;
  camera.aperture = setting.aperture;
  if (setting.turned) {
    camera.position->z = -1;
    camera.look_at = WorldPoint{camera.position->u + 0.1, camera.position->v + 0.05, 0};
  }
  return *frame_record(camera, header);
}

// Draws one turn of the orbit and prints a row of the table.
bool print_turn(const Setting& setting, const char* state, const Decoder& decoder,
                FrameRenderer& renderer) {
  FrameSeconds seconds;
  FrameCounts counts;
  Frame frame;
  const bench::Clock clock;
  for (int k = 0; k < kFrames; ++k) {
    if (!renderer.render(record_of(setting, decoder.header(), k), 0, frame)) return false;
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
  return true;
}

bool print_frames(std::span<const uint8_t> file) {
  fmt::print(
      "| 512x512, orbit of {} frames | cache | frames/s | CPU ms a frame | plan | decode | sample "
      "| blocks needed | decoded |\n|---|---|---|---|---|---|---|---|---|\n",
      kFrames);
  const Setting settings[] = {{"quadrilinear"},
                              {"quadrilinear, nothing kept", Filter::kQuadrilinear, 0, false, 0},
                              {"quadrilinear, turned", Filter::kQuadrilinear, 0, true},
                              {"quadrilinear, aperture 1", Filter::kQuadrilinear, 1},
                              {"bilinear", Filter::kBilinear},
                              {"nearest", Filter::kNearest}};
  for (const Setting& setting : settings) {
    // A new decoder, which has not decoded any key image.
    const auto decoder = Decoder::open(file, {false, {}, nullptr});
    if (!decoder) return false;
    RenderOptions options;
    options.cache_bytes = setting.cache_bytes;
    const auto renderer = make_cpu_renderer(*decoder, options);
    if (!print_turn(setting, "cold", *decoder, *renderer)) return false;
    if (!print_turn(setting, "warm", *decoder, *renderer)) return false;
  }
  return true;
}

void print_peer(const char* name, double seconds, double own, double psnr) {
  fmt::print("| {} | {:.3f} | {:.2f} | {} |\n", name, seconds * 1e3, seconds / own,
             std::isfinite(psnr) ? fmt::format("{:.2f} dB", psnr) : "");
  std::fflush(stdout);
}

// Decoding one view, on one thread, beside other codecs.
bool print_view(std::span<const uint8_t> file, const LightField& field) {
  const auto decoder = Decoder::open(file);
  if (!decoder) return false;
  const StreamHeader& header = decoder->header();
  const ViewPos view{header.rows / 2 - 1, header.cols / 2 - 2};  // no key image
  const RgbImage original = field.view(view.row, view.col);
  const auto decoded = decoder->decode_view(view);
  if (!decoded) return false;
  const auto psnr_of = [&](const RgbImage& image) {
    return psnr(measure(original, image).rgb_squares, original.samples.size(), original.depth);
  };
  const double own_psnr = psnr_of(*decoded);
  const double own = bench::cpu_seconds_of([&] { (void)decoder->decode_view(view); });
  fmt::print(
      "\n| one view of {} x {}, one thread | CPU ms | times | PSNR RGB |\n|---|---|---|---|\n",
      header.width, header.height);
  print_peer("HMLFC", own, own, own_psnr);
  RgbImage copy = *decoded;
  const double copying = bench::cpu_seconds_of(
      [&] { std::copy(decoded->samples.begin(), decoded->samples.end(), copy.samples.begin()); });
  print_peer("memcpy of its output", copying, own, INFINITY);
  for (const auto& peer : {bench::openjpeg_peer(original, own_psnr), bench::astc_peer(original)}) {
    if (!peer) return false;
    print_peer(peer->name.c_str(), peer->seconds, own, psnr_of(peer->decoded));
  }
  return true;
}

std::vector<uint8_t> encoded_chess(const LightField& field) {
  EncodeParams params;
  params.extended.quality = 64;
  auto stream = encode(field, params);
  return stream ? std::move(stream->bytes) : std::vector<uint8_t>{};
}

}  // namespace

int main(int argc, char** argv) {
  const auto views = io::list_views(argc > 2 ? std::filesystem::path(argv[2])
                                             : data_folder("stanford-chess-16x16-700x400"));
  const auto field = views ? io::load_light_field(*views, 0) : tl::unexpected(views.error());
  if (!field) {
    fmt::print(stderr, "skipped: {}\n", field.error().message);
    return 1;
  }
  std::vector<uint8_t> file;
  if (argc > 1) {
    const auto mapped = io::MappedFile::open(argv[1]);
    if (!mapped) {
      fmt::print(stderr, "{}\n", mapped.error().message);
      return 1;
    }
    file.assign(mapped->bytes().begin(), mapped->bytes().end());
  } else {
    file = encoded_chess(*field);
  }
  const bool done = print_frames(file) && print_view(file, *field);
  if (!done) fmt::print(stderr, "the stream does not decode\n");
  return done ? 0 : 1;
}
