// hmlfc synth: renders a synthetic light field to a folder of views.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/for_each_view.hpp"
#include "cli/view_source.hpp"
#include "io/disparity_files.hpp"
#include "io/files.hpp"
#include "io/light_field_files.hpp"
#include "io/rig_text.hpp"
#include "io/view_name.hpp"
#include "scenes/scene.hpp"
#include "terminal/clock.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

using scenes::Cameras;
using scenes::Scene;

constexpr const char* kSynthSign = "hmlfc synth";

struct SynthOptions {
  scenes::SceneParams scene;
  std::optional<double> baseline;
  int threads = 0;
  std::filesystem::path folder;
  bool force = false;
  std::filesystem::path disparity;
  std::filesystem::path rig;
};

// The disparities of all views as PFM files.
void write_disparities(const SynthOptions& options, const scenes::SceneParams& params) {
  FirstFailure first;
  terminal::ProgressBar progress("Disparities", "views");
  const auto write = [&](uint32_t row, uint32_t col, std::span<const float> pixels) {
    guard(first, size_t{row} * params.cols + col, [&] {
      const auto file =
          options.disparity / (io::view_stem(row, col, params.rows, params.cols) + ".pfm");
      value_or_throw(io::write_pfm(file, params.width, params.height, pixels), ExitCode::kOutput);
    });
  };
  scenes::render_disparities(params, static_cast<unsigned>(options.threads), progress.callback(),
                             write);
  progress.clear();
  rethrow(first);
}

void write_rig(const std::filesystem::path& file, const scenes::SceneParams& params) {
  const auto rig = scenes::scene_rig(params);
  if (!rig) throw Failure(ExitCode::kUsage, "--rig: no cameras take this scene; choose another");
  const std::string text = io::rig_text(*rig) + "\n";
  value_or_throw(io::write_file(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()}),
                 ExitCode::kOutput);
}

ExitCode run_synth(const SynthOptions& options) {
  scenes::SceneParams params = options.scene;
  params.baseline_px = options.baseline.value_or(params.baseline_px);
  const auto views = io::view_file_names({params.rows, params.cols}, io::FileNames::kRowCol);
  if (!options.disparity.empty()) {
    if (params.scene == Scene::kNoise) {
      throw Failure(ExitCode::kUsage, "--disparity: scene noise has none; choose another scene");
    }
    if (params.cameras != Cameras::kGrid) {
      throw Failure(ExitCode::kUsage,
                    "--disparity needs --cameras grid: it counts pixels a column");
    }
    std::vector<std::string> maps;
    for (const std::string& view : views)
      maps.push_back(std::filesystem::path(view).stem().string() + ".pfm");
    make_output_folder(options.disparity, maps, {"", options.force});
  }
  if (params.cameras != Cameras::kGrid && !scenes::scene_rig(params)) {
    throw Failure(ExitCode::kUsage, "--cameras: no cameras take this scene; choose another");
  }
  check_extension(options.folder, "a folder of views", {});
  if (!options.rig.empty()) check_replaceable({options.rig}, {"", options.force});
  make_output_folder(options.folder, views, {kSynthSign, options.force});
  if (!options.rig.empty()) write_rig(options.rig, params);
  const Clock clock;
  const auto threads = static_cast<unsigned>(options.threads);
  const LightFieldShape shape{params.rows, params.cols, params.width, params.height, params.depth};

  terminal::ProgressBar rendering("Rendering", "views");
  value_or_throw(
      io::save_views(options.folder, {params.rows, params.cols}, scenes::view_renderer(params),
                     threads, rendering.callback(), {io::FileNames::kRowCol, kSynthSign}),
      ExitCode::kOutput);
  rendering.clear();
  if (!options.disparity.empty()) write_disparities(options, params);

  print(fmt::format("{}: {}, {:.1f} s\n", options.folder.string(), describe(shape),
                    clock.wall_seconds()));
  return ExitCode::kDone;
}

}  // namespace

void add_synth(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "synth", "Render a synthetic light field", run_synth,
      R"(Writes one PNG per view, named by row and column: 00_00.png, 00_01.png ... The same arguments give
the same images on every machine. --disparity also writes what a decoder has to guess: 00_00.pfm ...
with the true disparity of every pixel, in pixels a column, negative for what is nearer than the middle
of the scene (hmlfc disparity --help). --rig writes where the cameras stand, for encode --rig. They are
on a regular grid, with --cameras plane a little off it, or turned to the scene's middle: on a sphere
around it, or along a path through all views, row by row.

Example:
  hmlfc synth --scene cards --grid 9x9 --size 512x384 -o views)");
  scenes::SceneParams& scene = options.scene;
  add_choice(app, "--scene", scene.scene,
             {{"cards", Scene::kCards},
              {"knights", Scene::kKnights},
              {"glass", Scene::kGlass},
              {"flat", Scene::kFlat},
              {"noise", Scene::kNoise}},
             "What to render")
      ->required();
  add_rows_by_cols(app, "--grid", scene.rows, scene.cols, io::kMaxGridSide,
                   "Views as rows x columns")
      ->required()
      ->default_str("");
  add_sides(app, "--size", "WxH", "width x height", 65536, "512x384",
            "Pixels of a view, width x height",
            [&scene](uint32_t width, uint32_t height) {
              scene.width = width;
              scene.height = height;
            })
      ->required();
  add_decimal(app, "--baseline", "PX", options.baseline, 0, 64,
              "Parallax between neighbouring views at depth 1, in pixels")
      ->default_str(fmt::format("{}", scene.baseline_px));
  add_choice(app, "--cameras", scene.cameras,
             {{"grid", Cameras::kGrid},
              {"plane", Cameras::kPlane},
              {"sphere", Cameras::kSphere},
              {"path", Cameras::kPath}},
             "Where the cameras stand")
      ->default_str("grid");
  add_integer(app, "--seed", scene.seed, 0, ~uint64_t{0}, "Varies positions, colours and textures");
  add_integer(app, "--depth", scene.depth, 8, 12, "Bits per sample");
  add_path(app, "--disparity", options.disparity,
           "Folder for the true disparity of each view, created if missing")
      ->required(false)
      ->type_name("DIR");
  add_path(app, "--rig", options.rig, "File for the positions and intrinsics of all cameras")
      ->required(false)
      ->type_name("FILE.json");
  add_threads(app, options.threads);
  add_output(app, options.folder, options.force, "DIR", "Folder for the views, created if missing");
}

}  // namespace hmlfc::cli
