// Draws frames with the GPU renderer, kernels replaced where asked, until one is not the golden
// renderer's: prints `CASE: REASON`. Where nothing else is said every buffer ends at a page that
// nobody may touch, so a kernel that reads or writes past its buffers ends the process.
//
// Exit: 0 all frames are equal, 1 one is not, 2 nothing can be read, 77 no device can guard its
// buffers; those of CLI11 for wrong usage.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "gpu/frame_cases.hpp"
#include "gpu/kernel_files.hpp"
#include "gpu/render_pair.hpp"

namespace {

using namespace hmlfc;
using namespace hmlfc::gpu;

constexpr int kEqual = 0;
constexpr int kDifferent = 1;
constexpr int kUnreadable = 2;
constexpr int kSkipped = 77;
constexpr uint64_t kLittle = uint64_t{1} << 14;  // bytes of decoded blocks that are kept
constexpr uint64_t kPlenty = uint64_t{1} << 24;

constexpr uint64_t kChunkBytes = 1024;  // so that streams and pools are in several chunks
constexpr int kFrames = 60;             // of a walk

struct Case {
  std::string name;
  std::function<std::string(Device&)> difference;
  bool chunked = false;  // in chunks, and without these pages
};

std::string difference_before(Device& device, std::vector<uint8_t> bytes, uint64_t cache_bytes,
                              uint32_t seed, int frames = kFrames) {
  RenderPair pair(device, std::move(bytes), cache_bytes);
  if (pair.closed()) return "it does not open";
  FrameTally tally;
  return difference_of_walk(pair, seed, frames, tally);
}

// Walks of a camera before random streams, with and without geometry.
Case walk(uint32_t seed, bool chunked) {
  const uint64_t cache_bytes = seed % 2 == 0 ? kLittle : kPlenty;
  const auto difference = [=](Device& device) {
    return difference_before(device, test::random_stream(seed), cache_bytes, seed);
  };
  return {fmt::format("{}-{}", chunked ? "chunks" : "walk", seed), difference, chunked};
}

double between(test::Random& random, double lo, double hi) {
  return lo + (hi - lo) * random() / 4294967296.0;
}

// The camera of frame `i`.
using CameraOf = std::function<Camera(test::Random&, const StreamHeader&, int)>;

// `frames` frames before random stream `seed`, of which some must have what `shown` counts.
// Cameras that take no frame are left out.
Case cameras(const char* name, uint32_t seed, int frames, uint64_t FrameTally::*shown,
             const CameraOf& camera_of) {
  const auto difference = [=](Device& device) -> std::string {
    RenderPair pair(device, test::random_stream(seed), kPlenty);
    if (pair.closed()) return "it does not open";
    test::Random random(seed);
    FrameTally tally;
    for (int i = 0; i < frames; ++i) {
      const auto record = frame_record(camera_of(random, pair.header(), i), pair.header());
      if (!record) continue;
      if (auto found = pair.difference(*record, 0, tally); !found.empty()) return found;
    }
    return tally.*shown == 0 ? "no frame shows what it is for" : "";
  };
  return {fmt::format("{}-{}", name, seed), difference};
}

// Turned far from straight ahead, near the views.
Camera turned(test::Random& random, const StreamHeader& header, int) {
  Camera camera = test::random_camera_with_geometry(random, header);
  WorldPoint& at = *camera.position;
  camera.focal = between(random, 2, 12);  // so that views hold steep rays
  at.z = between(random, -0.5, 0.5);
  const double u = at.u + between(random, -3, 3);
  camera.look_at = WorldPoint{u, at.v + between(random, -3, 3), at.z + 1};
  return camera;
}

// In the plane of the views, between the first columns of them. First by eighths of a step, where
// views have weights that are equal to bounds of SRF-3, and with a focal plane so far away that
// views disagree; then closer to the first one, where a little more shows, with displacements at
// their bounds.
Camera between_columns(test::Random&, const StreamHeader&, int i) {
  Camera camera;
  camera.position = WorldPoint{i < 8 ? i / 8.0 : i % 8 / 64.0 + 1 / 4096.0, 0, 0};
  camera.geometry = GeometrySource::kStream;
  camera.focus = i < 8 ? 12 : i < 16 ? 200 : -200;
  return camera;
}

// Beside a grid of one column or one row: rays take its border (RAY-3).
Camera aside(test::Random&, const StreamHeader& header, int i) {
  Camera camera;
  camera.position = WorldPoint{i - 2.75, 0.25, 0};
  if (header.rows == 1) std::swap(camera.position->u, camera.position->v);
  camera.geometry = GeometrySource::kStream;
  return camera;
}

// Its rays meet about a point of the focal plane: a group of pixels shows few pixels of many views,
// or of what lies `outside` the first one, and displacements move them far apart.
Camera gathered(test::Random& random, const StreamHeader& header, int i, bool outside) {
  Camera camera;
  camera.geometry = GeometrySource::kStream;
  camera.frame_width = 1 + random() % 16;
  camera.frame_height = 1 + random() % 16;
  camera.focal = between(random, 2, 30);
  camera.focus = (i % 2 == 0 ? 1 : -1) * between(random, 0.2, 4) * (outside ? 10 : 1);
  const double z = -*camera.focal / camera.focus * between(random, 0.8, 1.2);
  const double u = between(random, 0, header.cols - 1);
  const double v = between(random, 0, header.rows - 1);
  camera.position = outside ? WorldPoint{-0.25, -0.25, z} : WorldPoint{u, v, z};
  const double steps = outside ? 0.5 : header.cols;
  camera.tan_half = std::clamp(steps / std::abs(z) * between(random, 0.25, 1), 0.001, 2.0);
  return camera;
}

// A small frame with rays of slope 4, the least that is outside (RAY-2): direction (0.6, 0, 0.8)
// and 13/16 of (0.8, 0, -0.6) to its right are (1.25, 0, 0.3125). A focal length of one pixel keeps
// such rays in the picture.
Camera steep(test::Random&, const StreamHeader&, int i) {
  Camera camera;
  camera.focal = 1;
  camera.tan_half = 1.625;
  camera.frame_width = camera.frame_height = 2 + 4 * (static_cast<uint32_t>(i) / 4);
  camera.row_pitch = 1;
  camera.position = WorldPoint{0, 0, 0};
  const double away = i % 2 == 0 ? 3 : -3;
  camera.look_at = i % 4 < 2 ? WorldPoint{away, 0, 4} : WorldPoint{0, away, 4};
  return camera;
}

Case gathered_rays(uint32_t seed, bool outside) {
  return cameras(outside ? "outside" : "gathered", seed, 12, &FrameTally::displaced,
                 [=](test::Random& random, const StreamHeader& header, int i) {
                   return gathered(random, header, i, outside);
                 });
}

Case damaged_walk(uint32_t seed) {
  return {fmt::format("damaged-{}", seed), [=](Device& device) {
            auto bytes = test::random_stream(seed);
            tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
            return difference_before(device, std::move(bytes), kPlenty, seed);
          }};
}

// Frames with geometry.
Case scenes(const char* name, tb::Damage damage) {
  return {name, [=](Device& device) {
            FrameTally tally;
            return difference_of_scenes(device, 3, damage, kLittle, tally);
          }};
}

// Two views of more than twice the blocks that there is room for at first: then there is room for
// just as many.
Case whole_views() {
  return {"whole-views", [](Device& device) {
            RenderPair pair(device, stream_of_many_blocks(), kPlenty);
            Camera camera;
            camera.position = WorldPoint{0.5, 0, 0};
            FrameTally tally;
            return pair.difference(*frame_record(camera, pair.header()), 0, tally);
          }};
}

Case many_blocks() {
  return {"many-blocks", [](Device& device) {
            return difference_before(device, stream_of_many_blocks(), kPlenty, 1, 8);
          }};
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (uint32_t seed = 0; seed < 6; ++seed) cases.push_back(walk(seed, false));
  for (uint32_t seed = 6; seed < 10; ++seed) cases.push_back(walk(seed, true));
  for (uint32_t seed = 10; seed < 14; ++seed)
    cases.push_back(cameras("turned", seed, kFrames, &FrameTally::lit, turned));
  cases.push_back(cameras("steep", 0, 12, &FrameTally::lit, steep));
  for (const uint32_t seed : {11u, 84u})
    cases.push_back(cameras("aside", seed, 7, &FrameTally::displaced, aside));
  cases.push_back(gathered_rays(57, false));
  cases.push_back(gathered_rays(15, true));
  cases.push_back(cameras("between", 6, 24, &FrameTally::displaced, between_columns));
  cases.push_back(scenes("scenes", tb::Damage::kNone));
  for (uint32_t seed = 200; seed < 203; ++seed) cases.push_back(damaged_walk(seed));
  cases.push_back(scenes("damaged-scenes", tb::Damage::kTiles));
  cases.push_back(many_blocks());
  cases.push_back(whole_views());
  return cases;
}

int run(const DeviceOptions& options, const std::vector<std::string>& names) {
  DeviceOptions in_chunks = options;
  in_chunks.chunk_bytes = kChunkBytes;
  in_chunks.guard_pages = false;
  auto device = Device::open(options);
  auto chunked = Device::open(in_chunks);
  if (!device || !chunked) {
    fmt::print(stderr, "{}\n", (device ? chunked : device).error().message);
    return kSkipped;
  }
  for (const Case& one : all_cases()) {
    if (!names.empty() && std::ranges::find(names, one.name) == names.end()) continue;
    const std::string found = one.difference(one.chunked ? *chunked : *device);
    if (found.empty()) continue;
    fmt::print("{}: {}\n", one.name, found);
    return kDifferent;
  }
  return kEqual;
}

}  // namespace

int main(int argc, char** argv) {
  DeviceOptions options;
  std::vector<std::string> kernels;
  std::vector<std::string> cases;
  options.guard_pages = true;
  options.cache_folder = "";
  if (const char* name = std::getenv("HMLFC_GPU_DEVICE")) options.device = name;
  CLI::App app{"Draws frames with the GPU renderer, until one is not the golden renderer's"};
  app.add_option("--kernel", kernels, "NAME=FILE.spv, in place of the library's own");
  app.add_option("--case", cases, "Only these");
  CLI11_PARSE(app, argc, argv);
  try {
    options.kernels = read_kernels(kernels);
    return run(options, cases);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kUnreadable;
  }
}
