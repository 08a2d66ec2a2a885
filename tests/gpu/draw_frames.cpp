// Draws frames with the GPU renderer, kernels replaced where asked, until one is not the golden
// renderer's: prints `CASE: REASON`. Every buffer ends at a page that nobody may touch, so a kernel
// that reads or writes past its buffers ends the process.
//
// Exit: 0 all frames are equal, 1 one is not, 2 nothing can be read, 77 no device can guard its
// buffers; those of CLI11 for wrong usage.
#include <algorithm>
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

struct Case {
  std::string name;
  std::function<std::string(Device&)> difference;
};

std::string difference_before(Device& device, std::vector<uint8_t> bytes, uint64_t cache_bytes,
                              uint32_t seed) {
  RenderPair pair(device, std::move(bytes), cache_bytes);
  if (pair.closed()) return "it does not open";
  FrameTally tally;
  return difference_of_walk(pair, seed, 8, tally);
}

// Walks of a camera before random streams, with and without geometry.
Case walk(uint32_t seed, uint64_t cache_bytes) {
  return {fmt::format("walk-{}", seed), [=](Device& device) {
            return difference_before(device, test::random_stream(seed), cache_bytes, seed);
          }};
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
            return difference_of_scenes(device, 4, damage, kLittle, tally);
          }};
}

Case many_blocks() {
  return {"many-blocks", [](Device& device) {
            return difference_before(device, stream_of_many_blocks(), kPlenty, 1);
          }};
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (uint32_t seed = 0; seed < 8; ++seed) {
    cases.push_back(walk(seed, seed % 2 == 0 ? kLittle : kPlenty));
  }
  cases.push_back(scenes("scenes", tb::Damage::kNone));
  for (uint32_t seed = 200; seed < 204; ++seed) cases.push_back(damaged_walk(seed));
  cases.push_back(scenes("damaged-scenes", tb::Damage::kTiles));
  cases.push_back(many_blocks());
  return cases;
}

int run(const DeviceOptions& options, const std::vector<std::string>& names) {
  auto device = Device::open(options);
  if (!device) {
    fmt::print(stderr, "{}\n", device.error().message);
    return kSkipped;
  }
  for (const Case& one : all_cases()) {
    if (!names.empty() && std::ranges::find(names, one.name) == names.end()) continue;
    const std::string found = one.difference(*device);
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
  app.add_option("--chunk-bytes", options.chunk_bytes);
  CLI11_PARSE(app, argc, argv);
  try {
    options.kernels = read_kernels(kernels);
    return run(options, cases);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kUnreadable;
  }
}
