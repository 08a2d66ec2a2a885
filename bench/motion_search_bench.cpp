// The exact motion search against its scalar definition, on the residual views of light fields.
//
// The reference is the luma residual of one view (view minus the mean of its 2x2 cluster). The
// blocks are those of three other views of the same 4x4 views that are worth coding: the absolute
// values sum to at least 75 in 4x4 samples. Each round times the fast search of all blocks, with
// the previous match as the hint, and the definition on some of them, and compares the results.
//
// Columns, in CPU time of one thread: Time is the fast search of one block; definition_us the
// definition; ratio is definition / fast.
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "arithmetic/colour.hpp"
#include "encoder/motion_search.hpp"
#include "io/data_folder.hpp"
#include "io/image_files.hpp"
#include "scenes/scene.hpp"
#include "terminal/clock.hpp"

namespace {

using hmlfc::MotionMatch;
using hmlfc::ReferencePlane;
using Plane = std::vector<int16_t>;

constexpr uint32_t kWidth = 700;
constexpr uint32_t kHeight = 400;

/// 4x4 views: view_at(row, col) for row and col in [0, 3].
template <class ViewAt>
std::vector<Plane> luma_of_views(const ViewAt& view_at) {
  std::vector<Plane> planes;
  for (uint32_t view = 0; view < 16; ++view) {
    const hmlfc::RgbImage image = view_at(view / 4, view % 4);
    Plane plane(size_t{kWidth} * kHeight);
    for (size_t k = 0; k < plane.size(); ++k) {
      const uint16_t* rgb = image.samples.data() + 3 * k;
      plane[k] = static_cast<int16_t>(hmlfc::forward_colour({rgb[0], rgb[1], rgb[2]}).y);
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

std::optional<std::vector<Plane>> real_views() {
  const auto folder = hmlfc::real_data("stanford-chess-16x16-700x400");
  if (!folder) return std::nullopt;
  return luma_of_views([&](uint32_t row, uint32_t col) {
    const std::string name =
        "out_0" + std::to_string(4 + row) + "_0" + std::to_string(4 + col) + ".png";
    return hmlfc::io::read_image(*folder / name).value();
  });
}

std::vector<Plane> scene_views(hmlfc::scenes::Scene scene) {
  const hmlfc::LightField field = hmlfc::scenes::render_scene(
      {.scene = scene, .rows = 4, .cols = 4, .width = kWidth, .height = kHeight}, 0);
  return luma_of_views([&](uint32_t row, uint32_t col) { return field.view(row, col); });
}

/// Views "chess", "knights" or "noise", each made once. Nothing if there is no data.
const std::optional<std::vector<Plane>>& views_named(const std::string& name) {
  static std::map<std::string, std::optional<std::vector<Plane>>> cache;
  if (!cache.contains(name)) {
    cache[name] =
        name == "chess" ? real_views() : scene_views(hmlfc::scenes::scene_from_name(name).value());
  }
  return cache[name];
}

/// The view minus the rounded mean of its 2x2 cluster.
Plane residual_of(const std::vector<Plane>& views, size_t row, size_t col) {
  const size_t first = (row & ~size_t{1}) * 4 + (col & ~size_t{1});
  Plane residual(views[0].size());
  for (size_t k = 0; k < residual.size(); ++k) {
    const int sum =
        views[first][k] + views[first + 1][k] + views[first + 4][k] + views[first + 5][k];
    residual[k] = static_cast<int16_t>(views[row * 4 + col][k] - (sum + 2) / 4);
  }
  return residual;
}

struct Block {
  std::vector<int16_t> samples;
  uint32_t x;
  uint32_t y;
};

void add_blocks(const Plane& residual, uint32_t size, std::vector<Block>& blocks) {
  for (uint32_t y = 0; y + size <= kHeight; y += size) {
    for (uint32_t x = 0; x + size <= kWidth; x += size) {
      Block block{{}, x, y};
      int energy = 0;
      for (uint32_t k = 0; k < size * size; ++k) {
        block.samples.push_back(residual[size_t{y + k / size} * kWidth + x + k % size]);
        energy += std::abs(block.samples.back());
      }
      if (energy * 16 >= 75 * static_cast<int>(size * size)) {
        blocks.push_back(std::move(block));
      }
    }
  }
}

void motion_search(benchmark::State& state, const std::string& name, int size, int window) {
  const auto& views = views_named(name);
  if (!views) {
    state.SkipWithError("no Chess in HMLFC_DATA_DIR or ../shared/data");
    return;
  }
  const ReferencePlane reference(residual_of(*views, 0, 0), kWidth, kHeight, window);
  std::vector<Block> blocks;
  for (const auto& [row, col] : {std::pair{0, 1}, {1, 1}, {3, 3}}) {
    add_blocks(residual_of(*views, static_cast<size_t>(row), static_cast<size_t>(col)),
               static_cast<uint32_t>(size), blocks);
  }
  std::vector<MotionMatch> matches(blocks.size());
  const size_t every = blocks.size() / 500 + 1;
  double fast = 0;
  double definition = 0;
  size_t defined = 0;
  for ([[maybe_unused]] const auto round : state) {
    const hmlfc::Clock fast_clock;
    MotionMatch last{};
    for (size_t k = 0; k < blocks.size(); ++k) {
      const Block& block = blocks[k];
      last = matches[k] = search_motion(block.samples, size, block.x, block.y, reference, window,
                                        true, std::span(&last, 1));
    }
    const double seconds = fast_clock.cpu_seconds();
    const hmlfc::Clock definition_clock;
    bool same = true;
    for (size_t k = 0; k < blocks.size(); k += every, ++defined) {
      const Block& block = blocks[k];
      same &= matches[k] == search_motion_brute_force(block.samples, size, block.x, block.y,
                                                      reference, window, true);
    }
    definition += definition_clock.cpu_seconds();
    fast += seconds;
    state.SetIterationTime(seconds / static_cast<double>(blocks.size()));
    if (!same) {
      state.SkipWithError("the fast search differs from the definition");
    }
  }
  const double searched =
      static_cast<double>(state.iterations()) * static_cast<double>(blocks.size());
  state.counters["blocks"] = static_cast<double>(blocks.size());
  state.counters["definition_us"] = definition / static_cast<double>(defined) * 1e6;
  state.counters["ratio"] = definition / static_cast<double>(defined) / (fast / searched);
  state.SetLabel(hmlfc::motion_search_instruction_set());
}

const bool kRegistered = [] {
  for (const char* name : {"chess", "knights", "noise"}) {
    for (const auto& [size, window] : {std::pair{4, 16}, {4, 7}, {4, 33}, {2, 16}, {8, 16}}) {
      const std::string title = std::string("motion_search/") + name +
                                "/block:" + std::to_string(size) +
                                "/window:" + std::to_string(window);
      benchmark::RegisterBenchmark(title.c_str(),
                                   [name, size = size, window = window](benchmark::State& state) {
                                     motion_search(state, name, size, window);
                                   })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond)
          ->Iterations(10);
    }
  }
  return true;
}();

}  // namespace
