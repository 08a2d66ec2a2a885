// hmlfc render: novel views of a light field.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/camera_options.hpp"
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/quality_sweep.hpp"
#include "cli/render_backend.hpp"
#include "cli/stream_file.hpp"
#include "io/write_animation.hpp"
#include "io/write_image.hpp"

namespace hmlfc::cli {
namespace {

struct RenderArguments {
  std::filesystem::path file;
  std::filesystem::path output;
  std::filesystem::path preview;
  CameraOptions cameras;
  std::optional<int> levels;
  BackendChoice backend;
  uint32_t cache_mib = static_cast<uint32_t>(RenderOptions{}.cache_bytes >> 20);
  int threads = 0;
  bool progressive = false;
  bool sweep = false;
  bool json = false;
};

// Frames of more than this are not kept for the preview.
constexpr size_t kPreviewFrames = 240;
constexpr unsigned kPreviewRate = 20;  // frames a second

std::string frame_name(size_t frame) { return fmt::format("frame_{:04}.png", frame); }

Json camera_json(const Camera& camera) {
  Json json;
  json["position"] = {camera.position->u, camera.position->v, camera.position->z};
  json["look_at"] = {camera.look_at->u, camera.look_at->v, camera.look_at->z};
  json["tan_half"] = *camera.tan_half;
  json["focus"] = camera.focus;
  return json;
}

// The picture of a frame's pass that uses `levels` levels of the tree, beside that of the frame.
std::filesystem::path pass_name(std::filesystem::path frame, int levels) {
  return frame.replace_filename(fmt::format("{}_levels_{}.png", frame.stem().string(), levels));
}

// What one pass took. On a device the whole stream lies in its memory, and nobody counts what it
// reads: `touched` is null.
Json pass_json(const std::string& name, int levels, const Frame& frame,
               const TouchedBytes* touched) {
  Json json;
  json["file"] = name;
  json["levels"] = levels;
  json["seconds"] = frame.seconds.total();
  json["stages"] = {{"plan", frame.seconds.plan},
                    {"decode", frame.seconds.decode},
                    {"sample", frame.seconds.sample}};
  json["blocks_needed"] = frame.counts.blocks_needed;
  json["blocks_decoded"] = frame.counts.blocks_decoded;
  json["blocks_reused"] = frame.counts.blocks_reused;
  if (touched != nullptr) {
    json["bytes_touched"] = touched->bytes();
    json["key_samples_decoded"] = touched->key_samples();
    json["samples_interpolated"] = frame.counts.samples_interpolated;
  }
  return json;
}

// One file of a stream, its cameras and what is asked of them.
class RenderRun {
 public:
  explicit RenderRun(const RenderArguments& arguments)
      : arguments_(arguments),
        touched_(file_size(arguments.file)),
        file_(arguments.file, open_options()),
        cameras_(cameras_of(arguments.cameras, file_.header())),
        stop_level_(arguments.levels ? file_.stop_level(*arguments.levels) : 0) {
    for (size_t k = 0; k < cameras_.size(); ++k) record_of(k);
  }

  ExitCode frames() {
    const bool one_file = arguments_.output.extension() == ".png";
    if (one_file && cameras_.size() != 1) {
      throw Failure(ExitCode::kUsage,
                    "-o names one picture, but there are more frames: name a folder");
    }
    if (one_file) {
      check_output_file(arguments_.output);
    } else {
      make_output_folder(arguments_.output);
    }
    if (!arguments_.preview.empty()) check_output_file(arguments_.preview);
    const auto renderer = make_renderer(arguments_.backend, file_);
    ProgressBar progress("Rendering", "frames");
    for (size_t k = 0; k < cameras_.size(); ++k) {
      render_one(*renderer, k, one_file ? arguments_.output : arguments_.output / frame_name(k));
      progress.update(k + 1, cameras_.size());
    }
    progress.clear();
    if (!arguments_.preview.empty()) {
      value_or_throw(io::write_apng(arguments_.preview, preview_, kPreviewRate), ExitCode::kOutput);
    }
    report();
    return ExitCode::kDone;
  }

  ExitCode sweep() {
    ProgressBar progress("Rendering", "settings");
    const auto points = sweep_quality(file_, cameras_, arguments_.backend, progress.callback());
    progress.clear();
    if (arguments_.json) {
      Json rows = Json::array();
      for (const SweepPoint& point : points) {
        Json row;
        row["filter"] = filter_name(point.filter);
        row["levels"] = point.levels;
        row["cache"] = point.cached;
        row["seconds"] = point.seconds;
        row["psnr_rgb"] = psnr_json(point.psnr);
        rows.push_back(row);
      }
      print_json(rows);
      return ExitCode::kDone;
    }
    print("| filter | levels | cache | ms a frame | PSNR RGB |\n|---|---|---|---|---|\n");
    for (const SweepPoint& point : points) {
      print(fmt::format("| {} | {} | {} | {:.2f} | {} |\n", filter_name(point.filter), point.levels,
                        point.cached ? "yes" : "no", point.seconds * 1e3, psnr_text(point.psnr)));
    }
    return ExitCode::kDone;
  }

 private:
  static uint64_t file_size(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : size;  // opening it says why
  }

  // Only what frames need is read: no checksum of whole sections.
  OpenOptions open_options() {
    OpenOptions options;
    options.check_sections = false;
    options.reads = &touched_;
    return options;
  }

  FrameRecord record_of(size_t k) const {
    const auto record = frame_record(cameras_[k], file_.header());
    if (record) return *record;
    const std::string frame = cameras_.size() == 1 ? "" : fmt::format("frame {}: ", k);
    throw Failure(ExitCode::kUsage, frame + record.error().message);
  }

  int levels_of(int stop_level) const { return file_.header().tree_height + 1 - stop_level; }

  // Renders frame k down to `stop_level` and writes it.
  Json render_pass(FrameRenderer& renderer, size_t k, int stop_level,
                   const std::filesystem::path& name) {
    touched_.reset();
    value_or_throw(renderer.render(record_of(k), stop_level, frame_), file_.path());
    value_or_throw(io::write_png(name, frame_.image), ExitCode::kOutput);
    seconds_ += frame_.seconds.total();
    const bool counted = arguments_.backend.backend == Backend::kCpu;
    return pass_json(name.string(), levels_of(stop_level), frame_, counted ? &touched_ : nullptr);
  }

  void render_one(FrameRenderer& renderer, size_t k, const std::filesystem::path& name) {
    Json coarse = Json::array();
    const int first = arguments_.progressive ? file_.header().tree_height : stop_level_;
    for (int stop_level = first; stop_level > stop_level_; --stop_level) {
      coarse.push_back(
          render_pass(renderer, k, stop_level, pass_name(name, levels_of(stop_level))));
    }
    Json frame = render_pass(renderer, k, stop_level_, name);
    frame["camera"] = camera_json(with_defaults(cameras_[k], file_.header()));
    if (arguments_.progressive) frame["coarse"] = std::move(coarse);
    frames_.push_back(std::move(frame));
    if (!arguments_.preview.empty() && preview_.size() < kPreviewFrames) {
      preview_.push_back(frame_.image);
    }
  }

  void report() const {
    const double count = static_cast<double>(cameras_.size());
    if (!arguments_.json) {
      print(fmt::format("{}: {} frame{} of {} x {} pixels, {:.2f} ms each\n",
                        arguments_.output.string(), cameras_.size(),
                        cameras_.size() == 1 ? "" : "s", frame_.image.width, frame_.image.height,
                        seconds_ / count * 1e3));
      return;
    }
    Json json;
    json["width"] = frame_.image.width;
    json["height"] = frame_.image.height;
    json["filter"] = filter_name(arguments_.cameras.camera.filter);
    json["levels"] = levels_of(stop_level_);
    json["backend"] = arguments_.backend.backend == Backend::kCpu ? "cpu" : "gpu";
    json["seconds"] = seconds_;
    json["frames_per_second"] = count / seconds_;
    json["frames"] = frames_;
    print_json(json);
  }

  const RenderArguments& arguments_;
  TouchedBytes touched_;
  StreamFile file_;
  std::vector<Camera> cameras_;
  int stop_level_;
  Frame frame_;
  std::vector<RgbImage> preview_;
  double seconds_ = 0;
  Json frames_ = Json::array();
};

ExitCode run_render(RenderArguments& arguments) {
  const ThreadLimit limit(arguments.threads);
  arguments.backend.options.cache_bytes = size_t{arguments.cache_mib} << 20;
  arguments.backend.options.threads = arguments.threads;
  arguments.backend.options.progressive = arguments.progressive;
  if (!arguments.sweep && arguments.output.empty()) {
    throw Failure(ExitCode::kUsage, "-o is missing: name a folder, or a .png file for one frame");
  }
  RenderRun run(arguments);
  return arguments.sweep ? run.sweep() : run.frames();
}

}  // namespace

void add_render(CLI::App& program, Task& task) {
  const auto options = std::make_shared<RenderArguments>();
  CLI::App* app = program.add_subcommand("render", "Render novel views of a stream");
  add_path(*app, "FILE", options->file, "An .hmlfc file");
  add_output(*app, options->output, "DIR|FILE.png", "Folder for the frames, or one picture")
      ->required(false);
  add_camera_options(*app, options->cameras);
  add_levels(*app, options->levels);
  add_choice(*app, "--backend", options->backend.backend,
             {{"cpu", Backend::kCpu}, {"gpu", Backend::kGpu}}, "Where frames are drawn")
      ->default_str("cpu");
  app->add_option("--device", options->backend.device,
                  "Number of the device or part of its name, for gpu")
      ->type_name("NAME");
  add_integer(*app, "--cache", options->cache_mib, 0, 1u << 20,
              "MiB of decoded blocks kept between frames");
  add_path(*app, "--preview", options->preview, "Also all frames as one animated PNG")
      ->required(false)
      ->type_name("FILE.png");
  CLI::Option* progressive =
      app->add_flag("--progressive", options->progressive,
                    "First write each frame with 1, 2, ... levels of the tree");
  app->add_flag("--quality-vs-time", options->sweep,
                "Print time and error of each filter, level and cache instead")
      ->excludes(progressive);
  add_threads(*app, options->threads);
  app->add_flag("--json", options->json, "Print what each frame took as JSON");
  app->footer(
      R"(Places are counted in columns and rows of views; Z is the distance beyond the plane of the views, in
columns. Frames are the same bytes on every machine (docs/rendering.md). Of the stream only those
parts are read that the frames need; with --backend gpu it is put into the device's memory, and
bytes_touched, key_samples_decoded and samples_interpolated are left out of the JSON. Coarse frames
of --progressive are named after the frame and its levels: frame_0000_levels_1.png. Each is decoded
from the one before.

Example:
  hmlfc render chess.hmlfc --path orbit --frames 4 --size 96x96 -o orbit --json)");
  app->callback([&task, options] { task = [options] { return run_render(*options); }; });
}

}  // namespace hmlfc::cli
