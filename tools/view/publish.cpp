// hmlfc publish: a light field as files for any web server, drawn in the visitor's browser.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/camera_path.hpp"
#include "cli/commands.hpp"
#include "cli/render_backend.hpp"
#include "conform/block_commands.hpp"
#include "conform/report.hpp"
#include "conform/work_folder.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"
#include "syntax/geometry.hpp"
#include "terminal/progress_bar.hpp"
#include "view/assets.hpp"

namespace hmlfc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSign = "hmlfc publish";
constexpr std::string_view kStream = "light-field.hmlfc";
constexpr std::string_view kUnfinished = ".hmlfc-publish";  // what is made, until all is
constexpr unsigned kLoopRate = 10;                          // frames per second
constexpr int kLoopFrames = 30;
constexpr uint32_t kLoopSide = 320;                 // pixels of its longer side, at most
constexpr uint32_t kStillSide = 1200;               // likewise
constexpr uint64_t kMostBytes = uint64_t{1} << 31;  // MOST of ranged_file.js
constexpr int kAperture = 1;                        // of the page, where none is told

// The page's modules that other pages share, and its own.
constexpr std::array<std::string_view, 10> kPageFiles{
    "player.js",   "live_view.js", "gpu_frames.js", "look_controls.js", "tilt.js",
    "palette.css", "look.css",     "camera.js",     "dom.js",           "gestures.js"};
// What is next to the kernels and for decoding blocks alone.
constexpr std::array<std::string_view, 5> kOtherFiles{"batch.js", "colour.wgsl", "hmlfc_gpu.js",
                                                      "samples.wgsl", "walk.wgsl"};

struct PublishOptions {
  fs::path file;
  fs::path output;
  bool force = false;
  std::string title;
  std::string text;
  std::string address;
  CameraOptions cameras;
};

// The folder of kernels and module: of the build, or installed.
fs::path browser_folder() {
  std::error_code ignored;
  const fs::path bin = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"../gpu_ref/wgsl", "../share/hmlfc/wgsl"}) {
    if (fs::exists(bin / place / "hmlfc_stream.wasm", ignored))
      return (bin / place).lexically_normal();
  }
  throw Failure(
      ExitCode::kUsage,
      "this build of hmlfc cannot publish, because no compiler for WebAssembly was there: install "
      "clang, lld, libc++-dev-wasm32 and libclang-rt-dev-wasm32 of version 16 or 19 (Debian), and "
      "build it anew");
}

// `page` with the value of each name in place of {{name}}.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& values) {
  std::string text;
  for (size_t begin = page.find("{{"); begin != page.npos; begin = page.find("{{")) {
    const size_t end = page.find("}}", begin);
    text += page.substr(0, begin);
    text += values.at(page.substr(begin + 2, end - begin - 2));
    page.remove_prefix(end + 2);
  }
  return text.append(page);
}

// The frame size of a view, made smaller until its longer side has `most` pixels.
void set_size(Camera& camera, const StreamHeader& header, uint32_t most) {
  const double scale = std::min(1.0, most / (1.0 * std::max(header.width, header.height)));
  camera.frame_width = std::max(1u, static_cast<uint32_t>(std::lround(header.width * scale)));
  camera.frame_height = std::max(1u, static_cast<uint32_t>(std::lround(header.height * scale)));
}

class Publication {
 public:
  explicit Publication(const PublishOptions& options)
      : options_(options), modules_(browser_folder()), file_(options.file) {
    const std::string name = options.file.string();
    const auto refuse = [&](const char* why) { throw Failure(ExitCode::kUsage, name + why); };
    const std::string& address = options.address;
    const bool web = address.starts_with("https://") || address.starts_with("http://");
    if (!address.empty() && (!web || address.find_first_of(" ?#\"\\<>") != address.npos)) {
      throw Failure(ExitCode::kUsage, "--address: begins with https:// and is that of a folder");
    }
    if (file_.is_remote()) refuse(": publish a file, not an address");
    if (file_.size() > kMostBytes) {
      refuse(": browsers take 2 GiB at most: encode fewer --views, or with a lower --quality");
    }
    // The reference view of the middle: no view takes fewer bytes.
    const StreamHeader& header = file_.header();
    CameraOptions& cameras = options_.cameras;
    if (!cameras.camera.position) {
      const ImagePos middle{(header.rows - 1u) / 2, (header.cols - 1u) / 2};
      const ImagePos at = Geometry(header).reference_of(0, middle);
      cameras.camera.position = {static_cast<double>(at.col), static_cast<double>(at.row), 0};
    }
    if (!cameras.aperture) cameras.aperture = kAperture;
    read_disparities(*cameras.camera.position);
    camera_ = cameras_of(cameras, file_).cameras.front();
    if (const WorldPoint& at = *camera_.position;
        at.u < 0 || at.v < 0 || at.u > header.cols - 1 || at.v > header.rows - 1) {
      throw Failure(ExitCode::kUsage, "--camera: outside the grid, which hmlfc info tells");
    }
  }

  void write() {
    const fs::path& folder = options_.output;
    make_output_folder(folder, {"index.html", "still.png", "loop.png"},
                       {kSign, options_.force, {options_.file}});
    const auto lock = take_output_folder(folder);
    for (const auto& entry : fs::directory_iterator(folder)) {  // of runs that were interrupted
      if (entry.path().filename().string().starts_with(kUnfinished))
        conform::remove_tree(entry.path());
    }
    const conform::WorkFolder made(folder / kUnfinished);
    if (made.error()) throw Failure(ExitCode::kOutput, folder.string() + ": cannot be written");
    made_ = made.path();
    write_programs();
    std::error_code ignored;
    if (!fs::equivalent(options_.file, folder / kStream, ignored)) copy(options_.file, kStream);
    // A folder whose page this command wrote may be replaced, all of it.
    if (!fs::exists(folder / "index.html")) check_replaceable(files(folder), {"", options_.force});
    write_pictures();
    write_page();
    put_in_place();
  }

 private:
  // What is made, in `folder`.
  std::vector<fs::path> files(const fs::path& folder = {}) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(made_)) {
      const fs::path file = entry.path().lexically_relative(made_);
      if (entry.is_regular_file()) files.push_back(folder / file);
    }
    return files;
  }

  // The page first: it has the sign, for another run should this one end in between.
  void put_in_place() const {
    make_output_folder(options_.output / "app");
    std::vector<fs::path> made = files();
    std::ranges::partition(made, [](const fs::path& file) { return file == "index.html"; });
    for (const fs::path& file : made) {
      std::error_code failure;
      fs::rename(made_ / file, options_.output / file, failure);
      if (failure) throw Failure(ExitCode::kOutput, file.string() + ": " + failure.message());
    }
  }

  void write_programs() const {
    make_output_folder(made_ / "app");
    for (const auto& entry : fs::directory_iterator(modules_)) {
      const std::string name = entry.path().filename().string();
      if (std::ranges::find(kOtherFiles, name) == kOtherFiles.end())
        copy(entry.path(), "app/" + name);
    }
    for (const auto name : kPageFiles) put("app" / fs::path(name), view::find_asset(name)->content);
    put("embed.js", view::find_asset("embed.js")->content);
  }

  void copy(const fs::path& from, const fs::path& to) const {
    const auto file = value_or_throw(io::map_file(from), ExitCode::kInput);
    value_or_throw(io::write_file(made_ / to, file.bytes()), ExitCode::kOutput);
  }

  void put(const fs::path& name, std::string_view text) const {
    const auto* bytes = reinterpret_cast<const uint8_t*>(text.data());
    value_or_throw(io::write_file(made_ / name, {bytes, text.size()}), ExitCode::kOutput);
  }

  // `part`: of the greatest field of view that a view fills.
  RgbImage frame(FrameRenderer& renderer, Camera camera, uint32_t side, double part = 1) {
    set_size(camera, file_.header(), side);
    camera.tan_half = part * *with_defaults(camera, file_.header()).tan_half;
    const auto record = frame_record(camera, file_.header());
    if (!record) throw Failure(ExitCode::kUsage, record.error().message);
    Frame drawn;
    file_.value(renderer.render(*record, 0, drawn));
    return std::move(drawn.image);
  }

  // What the view at `at` shows: the focus in the middle, where none is told, that of what there
  // is, and the focus that the page offers, a quarter as much more on each side.
  void read_disparities(const WorldPoint& at) {
    const StreamHeader& header = file_.header();
    const auto map = disparity_map(file_.decoder(), nearest_view(header, at));
    scene_ = map ? known_range(*map) : std::nullopt;
    if (!scene_) return;
    const auto [least, most] = *scene_;
    const double aside = std::max(0.5, (most - least) / 4);
    focus_range_ = {std::max(-256.0, least - aside), std::min(256.0, most + aside)};
    CameraOptions& cameras = options_.cameras;
    const BlockDisparity& middle = map->at(header.width / 2u, header.height / 2u);
    const bool told = cameras.focus || cameras.focus_at || cameras.focus_at_infinity;
    if (told || middle.confidence == 0) return;
    const double focus = static_cast<double>(middle.disparity) / kDisparityUnits;
    cameras.focus = {focus, focus};
  }

  // The pictures for previews and for browsers that cannot draw. The still is the first frame of
  // the page: sharp. In the moving one the focus goes from near to far and back.
  void write_pictures() {
    const auto renderer = make_renderer({}, file_);
    Camera sharp = camera_;
    sharp.aperture = 0;
    const RgbImage still = frame(*renderer, sharp, kStillSide);
    still_size_ = {still.width, still.height};
    const std::string sign(kSign);
    value_or_throw(io::write_png(made_ / "still.png", still, sign), ExitCode::kOutput);
    CameraOptions loop = options_.cameras;
    loop.path = "orbit";
    loop.frames = kLoopFrames;
    loop.camera.position.reset();  // in the view plane
    const auto [least, most] = scene_.value_or(std::array{camera_.focus, camera_.focus});
    // Between views the nearest one is up to half a step away, and what is in focus lies beside its
    // picture by half the disparity (RAY-5): so much stays out of sight, in place of black edges.
    const double step = std::max(std::abs(least), std::abs(most)) *
                        std::max(1.0, std::abs(*with_defaults(camera_, file_.header()).row_pitch));
    const double part =
        std::max(0.5, 1 - step / std::min(file_.header().width, file_.header().height));
    std::vector<RgbImage> frames;
    terminal::ProgressBar progress("Rendering", "frames");
    for (Camera camera : cameras_of(loop, file_).cameras) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(frames.size()) / kLoopFrames;
      camera.focus = least + (most - least) * (1 + std::cos(angle)) / 2;
      frames.push_back(frame(*renderer, camera, kLoopSide, part));
      progress.update(frames.size(), kLoopFrames);
    }
    progress.clear();
    value_or_throw(io::write_apng(made_ / "loop.png", frames, kLoopRate, sign), ExitCode::kOutput);
  }

  void write_page() const {
    const std::string name = file_.path().stem().string();
    const std::string address =
        options_.address + (options_.address.empty() || options_.address.ends_with('/') ? "" : "/");
    const double near = std::min(focus_range_[0], camera_.focus);
    const double far = std::max(focus_range_[1], camera_.focus);
    const WorldPoint& at = *camera_.position;
    put("index.html",
        filled(view::find_asset("player.html")->content,
               {{"title", conform::escaped(options_.title.empty() ? name : options_.title)},
                {"text", conform::escaped(options_.text)},
                {"address", conform::escaped(address)},
                {"width", std::to_string(still_size_[0])},
                {"height", std::to_string(still_size_[1])},
                {"camera", fmt::format("{},{},{}", at.u, at.v, at.z)},
                {"focus", fmt::format("{}", camera_.focus)},
                {"aperture", std::to_string(camera_.aperture)},
                {"near", fmt::format("{:.2f}", near)},
                {"far", fmt::format("{:.2f}", far)}}));
  }

  PublishOptions options_;
  fs::path modules_;
  fs::path made_{};  // what is to come into the folder
  StreamFile file_;
  Camera camera_;
  std::optional<std::array<double, 2>> scene_{};  // the disparities there are
  std::array<double, 2> focus_range_{-4, 4};
  std::array<uint32_t, 2> still_size_{};
};

ExitCode run_publish(const PublishOptions& options) {
  Publication(options).write();
  print(fmt::format(
      "{0}: copy this folder to a web server with https, best one that answers requests for\n"
      "ranges; here: python3 -m http.server -d {0} 8000    # then open http://127.0.0.1:8000/\n",
      conform::shell_word(options.output.string())));
  return ExitCode::kDone;
}

}  // namespace

void add_publisher(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "publish", "Make a web page that draws a light field in the visitor's browser",
      run_publish,
      R"(The folder holds the page, the stream as it is, which browsers fetch by ranges, a picture and a
moving one for previews, and loads nothing from elsewhere. Browsers without WebGPU, which they have
on https:// alone, show the moving picture. In another page: <iframe src="SITE/index.html">, or
SITE/embed.js and <light-field src="SITE/">.

Example:
  hmlfc publish chess.hmlfc -o site --title "Chess" --text "17 x 17 photographs")");
  add_stream(app, options.file)->description("An .hmlfc file");
  add_output(app, options.output, options.force, "FOLDER", "The folder to write");
  app.add_option("--title", options.title, "Title of the page (default: the name of the file)")
      ->type_name("TEXT");
  app.add_option("--text", options.text, "A sentence about it")->type_name("TEXT");
  app.add_option("--address", options.address,
                 "Where the folder will be: others show no previews without")
      ->type_name("URL");
  add_start_camera(app, options.cameras);
}

}  // namespace hmlfc::cli
