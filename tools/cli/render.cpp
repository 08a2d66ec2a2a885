// hmlfc render: novel views of a light field.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/camera_path.hpp"
#include "cli/outside_share.hpp"
#include "cli/preview.hpp"
#include "cli/render_backend.hpp"
#include "cli/render_json.hpp"
#include "cli/render_trace.hpp"
#include "cli/view_source.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kRenderSign = "hmlfc render";

struct RenderArguments {
  std::filesystem::path file;
  std::filesystem::path output;
  std::filesystem::path preview;
  bool force = false;
  CameraOptions cameras;
  std::optional<int> levels;
  BackendChoice backend;
  uint32_t cache_mib = static_cast<uint32_t>(RenderOptions{}.cache_bytes >> 20);
  int threads = 0;
  bool progressive = false;
  bool sweep = false;
  std::optional<FramePixel> trace;
  bool json = false;
};

std::string frame_name(size_t frame) { return fmt::format("frame_{:04}.png", frame); }

// The file of a coarse pass with `levels` levels of the tree, next to the frame's.
std::filesystem::path pass_name(std::filesystem::path frame, int levels) {
  return frame.replace_filename(fmt::format("{}_levels_{}.png", frame.stem().string(), levels));
}

// Renders the frames of one stream.
class RenderRun {
 public:
  explicit RenderRun(const RenderArguments& arguments)
      : arguments_(arguments),
        source_(open_source(arguments.file)),
        touched_(source_->bytes->bytes().size()),
        file_(arguments.file, source_, open_options()),
        path_(cameras_of(arguments.cameras, file_)),
        cameras_(path_.cameras),
        stop_level_(arguments.levels ? file_.stop_level(*arguments.levels) : 0) {}

  ExitCode frames() {
    prepare_output();
    for (size_t k = 0; k < cameras_.size() && !arguments_.preview.empty(); ++k) {
      if (std::filesystem::weakly_canonical(frame_path(k)) ==
          std::filesystem::weakly_canonical(arguments_.preview)) {
        throw Failure(ExitCode::kUsage,
                      arguments_.preview.string() + ": --preview and a frame have one name");
      }
    }
    Preview preview(arguments_.preview, kRenderSign, arguments_.force);
    if (arguments_.progressive && stop_level_ == file_.header().tree_height) {
      note(fmt::format(
          "--progressive writes no coarse frames: the frames use one level of the tree; "
          "{} has {} (encode --height sets how many)",
          arguments_.file.string(), file_.header().tree_height + 1));
    }
    const auto renderer = make_renderer(arguments_.backend, file_);
    terminal::ProgressBar progress("Rendering", "frames");
    for (size_t k = 0; k < cameras_.size(); ++k) {
      render_one(*renderer, k, frame_path(k));
      preview.add(frame_.image);
      progress.update(k + 1, cameras_.size());
    }
    progress.clear();
    preview.write(file_out_ ? file_out_->path() : arguments_.output);
    if (file_out_) file_out_->finish();
    report();
    return ExitCode::kDone;
  }

  ExitCode sweep() {
    print_quality_sweep(file_, cameras_, arguments_.backend, arguments_.json);
    return ExitCode::kDone;
  }

  ExitCode trace() {
    print_trace(file_, record_of(0), stop_level_, *arguments_.trace, arguments_.json);
    return ExitCode::kDone;
  }

 private:
  std::filesystem::path frame_path(size_t k) const {
    return file_out_ ? file_out_->path() : arguments_.output / frame_name(k);
  }

  // Makes the folder, or checks that the one PNG file can be written.
  void prepare_output() {
    const std::filesystem::path& output = arguments_.output;
    const Replacing replacing{kRenderSign, arguments_.force, {arguments_.file}};
    if (extension_of(output, ".png") == ".png") {
      if (cameras_.size() != 1) {
        throw Failure(ExitCode::kUsage,
                      "-o names one PNG file, but there are several frames: name a folder");
      }
      file_out_.emplace(output, ".png", replacing);
      if (file_out_->path() != output && arguments_.progressive) {
        throw Failure(ExitCode::kUsage, "--progressive writes several files: name one for -o");
      }
      std::vector<std::filesystem::path> coarse;
      for (const auto& name : coarse_names(output)) coarse.push_back(name);
      return check_replaceable(coarse, replacing);
    }
    check_extension(output, "a PNG file or a folder of them", {});
    std::vector<std::string> names;
    for (size_t k = 0; k < cameras_.size(); ++k) {
      for (const auto& name : coarse_names(frame_name(k))) names.push_back(name.string());
      names.push_back(frame_name(k));
    }
    make_output_folder(output, names, replacing);
  }

  // The files of the coarse passes of a frame.
  std::vector<std::filesystem::path> coarse_names(const std::filesystem::path& frame) const {
    std::vector<std::filesystem::path> names;
    const int first = arguments_.progressive ? file_.header().tree_height : stop_level_;
    for (int stop_level = first; stop_level > stop_level_; --stop_level) {
      names.push_back(pass_name(frame, levels_of(stop_level)));
    }
    return names;
  }

  // Reads only what frames need, so section checksums are not checked.
  OpenOptions open_options() { return {.check_sections = false, .reads = &touched_}; }

  FrameRecord record_of(size_t k) const { return *frame_record(cameras_[k], file_.header()); }

  // What was fetched since the last pass, with the first one also to open the stream.
  Json fetched_since(const remote::FetchCounts& now) {
    const remote::FetchCounts before = std::exchange(fetched_, now);
    return {{"bytes", now.bytes - before.bytes},
            {"requests", now.requests - before.requests},
            {"rounds", now.rounds - before.rounds}};
  }

  int levels_of(int stop_level) const { return file_.header().tree_height + 1 - stop_level; }

  // Renders frame k down to `stop_level` and writes it.
  Json render_pass(FrameRenderer& renderer, size_t k, int stop_level,
                   const std::filesystem::path& name) {
    touched_.reset();
    file_.value(renderer.render(record_of(k), stop_level, frame_));
    value_or_throw(io::write_png(name, frame_.image, kRenderSign), ExitCode::kOutput);
    seconds_ += frame_.seconds.total();
    const bool counted = arguments_.backend.backend == Backend::kCpu;
    Json json =
        pass_json((file_out_ && name == file_out_->path() ? arguments_.output : name).string(),
                  levels_of(stop_level), frame_, counted ? &touched_ : nullptr);
    if (const auto now = file_.fetched()) json["fetched"] = fetched_since(*now);
    return json;
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
    frame["outside"] = outside_.add(record_of(k), frame_.image);
    if (arguments_.progressive) frame["coarse"] = std::move(coarse);
    frames_.push_back(std::move(frame));
  }

  void report() const {
    const double count = static_cast<double>(cameras_.size());
    if (!arguments_.json) {
      print(fmt::format("{}: {} frame{} of {} x {} pixels, {:.2f} ms each\n",
                        arguments_.output.string(), cameras_.size(),
                        cameras_.size() == 1 ? "" : "s", frame_.image.width, frame_.image.height,
                        seconds_ / count * 1e3));
      if (path_.focus) print(focus_text());
      if (arguments_.cameras.path == "focus") {
        print(fmt::format("focus {} to {}\n", cameras_.front().focus, cameras_.back().focus));
      }
      print(outside_.text(file_.header()));
      return;
    }
    print_json({{"width", frame_.image.width},
                {"height", frame_.image.height},
                {"filter", filter_name(arguments_.cameras.camera.filter)},
                {"levels", levels_of(stop_level_)},
                {"backend", arguments_.backend.backend == Backend::kCpu ? "cpu" : "gpu"},
                {"seconds", seconds_},
                {"frames_per_second", count / seconds_},
                {"frames", frames_}});
  }

  // What --focus takes for the frames that --focus-at gave their focus.
  std::string focus_text() const {
    const FramePixel at = *arguments_.cameras.focus_at;
    return fmt::format("focus {} at {},{}\n", *path_.focus, at.x, at.y);
  }

  const RenderArguments& arguments_;
  std::shared_ptr<const remote::OpenSource> source_;
  TouchedBytes touched_;
  StreamFile file_;
  CameraPath path_;
  const std::vector<Camera>& cameras_;
  int stop_level_;
  Frame frame_;
  double seconds_ = 0;
  remote::FetchCounts fetched_;
  OutsideShare outside_;
  std::optional<OutputFile> file_out_;  // of the only frame
  Json frames_ = Json::array();
};

ExitCode run_render(const RenderArguments& given) {
  RenderArguments arguments = given;
  const ThreadLimit limit(arguments.threads);
  arguments.backend.options.cache_bytes = size_t{arguments.cache_mib} << 20;
  arguments.backend.options.threads = arguments.threads;
  arguments.backend.options.progressive = arguments.progressive;
  if (!arguments.sweep && !arguments.trace && arguments.output.empty()) {
    throw Failure(ExitCode::kUsage, "-o is missing: name a folder, or a *.png file for one frame");
  }
  RenderRun run(arguments);
  if (arguments.trace) return run.trace();
  return arguments.sweep ? run.sweep() : run.frames();
}

}  // namespace

void add_render(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "render", "Render novel views of a stream", run_render,
      R"(X and Y of a position are column and row of views, counted from 0; Z is the distance beyond the view
plane, in columns (docs/aiming.md draws it). Along a path --focus-at looks at the first frame, and what
it finds stays in focus. --path focus keeps the camera and moves the focus from the nearest to the
farthest that the stream knows of the view there, or as --focus D..D says. A PNG of --preview has the
first 240 frames.
With --geometry stream a surface is drawn where the stream says that it is, with plane only what lies in
the plane of --focus is sharp; apertures above 0 take the plane.
Pixels outside the light field are black; their share is printed, and is "outside" in the JSON.
Frames are the same bytes on every machine (docs/rendering.md). Only the parts of the stream that the
frames need are read; the JSON of one at an address says what was fetched. --backend gpu loads the
whole stream into the device's memory, and its JSON has no bytes_touched, key_samples_decoded and
samples_interpolated. The coarse frames of --progressive are named after the frame and its levels:
frame_0000_levels_1.png. Each is decoded from the one before.
--trace shows what each clause of docs/rendering.md computes for one pixel of the first frame, down to
the pixels of the views that it blends; its JSON has pixel, stages[]{stage, view, values[]{name, value,
clause}} and sample.
--quality-vs-time compares with frames computed in real numbers, filter quadrilinear and all levels.

Examples:
  hmlfc render chess.hmlfc --path orbit --frames 4 --size 96x96 -o orbit --json
  hmlfc render chess.hmlfc --path focus --frames 5 -o stack --preview stack.png)");
  add_stream(app, options.file);
  add_output(app, options.output, options.force, "DIR|FILE.png",
             "Folder for the frames, or one PNG file, - on standard output")
      ->required(false);
  add_camera_options(app, options.cameras);
  add_levels(app, options.levels);
  add_choice(app, "--backend", options.backend.backend,
             {{"cpu", Backend::kCpu}, {"gpu", Backend::kGpu}}, "Where frames are rendered")
      ->default_str("cpu");
  app.add_option("--device", options.backend.device,
                 "Number of the device or part of its name, for gpu")
      ->type_name("NAME");
  add_integer(app, "--cache", options.cache_mib, 0, 1u << 20,
              "MiB of decoded blocks kept between frames");
  add_path(app, "--preview", options.preview,
           "Also an animation: *.png, or *.gif or *.mp4 by the program ffmpeg")
      ->required(false)
      ->type_name("FILE");
  CLI::Option* trace = add_trace(app, options.trace);
  CLI::Option* progressive =
      app.add_flag("--progressive", options.progressive,
                   "First write each frame with 1, 2, ... levels of the tree");
  CLI::Option* sweep = app.add_flag("--quality-vs-time", options.sweep,
                                    "Print time and PSNR of each filter, level and cache instead");
  sweep->excludes(trace);
  for (CLI::Option* mode : {sweep, trace}) {
    mode->excludes(progressive, app.get_option("--output"), app.get_option("--preview"));
  }
  sweep->excludes(app.get_option("--levels"), app.get_option("--filter"));
  trace->excludes(app.get_option("--backend"));
  add_threads(app, options.threads);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
