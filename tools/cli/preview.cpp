#include "cli/preview.hpp"

#include <unistd.h>

#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/output.hpp"
#include "cli/output_files.hpp"
#include "conform/process.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"

namespace hmlfc::cli {
namespace {

constexpr size_t kPngFrames = 240;       // they are kept in memory
constexpr unsigned kRate = 20;           // frames per second
constexpr double kVideoSeconds = 86400;  // for ffmpeg
constexpr std::string_view kProgram = "ffmpeg";

bool is_video(const std::filesystem::path& file) {
  const std::string extension = io::lower_case_extension(file);
  return extension == ".gif" || extension == ".mp4";
}

conform::ProcessOutcome run_ffmpeg(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), std::string(kProgram));
  return conform::run_process(arguments, {kVideoSeconds, 0});
}

// A GIF gets the palette that suits its frames; MP4 has sides of even length and colours that every
// player shows. What a folder holds beyond the frames is left out: by trim before a palette is
// made, and by -frames where other sizes make the filters begin anew.
std::vector<std::string> coding_of(const std::filesystem::path& file, size_t frames) {
  const bool is_gif = io::lower_case_extension(file) == ".gif";
  const std::string filter =
      is_gif ? "split[a][b];[a]palettegen[p];[b][p]paletteuse" : "pad=ceil(iw/2)*2:ceil(ih/2)*2";
  std::vector<std::string> coding{"-vf", fmt::format("trim=end_frame={},{}", frames, filter),
                                  "-frames:v", std::to_string(frames), "-f"};
  if (is_gif) {
    coding.emplace_back("gif");
  } else {
    coding.insert(coding.end(), {"mp4", "-pix_fmt", "yuv420p"});
  }
  return coding;
}

// The name of ffmpeg's pattern for a folder: a % stands for itself.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '%' ? "%%" : std::string(1, c);
  return text;
}

// What ffmpeg reads: files frame_0000.png, ... of a folder, or one file.
std::vector<std::string> input_of(const std::filesystem::path& frames) {
  if (!std::filesystem::is_directory(frames)) {
    return {"-pattern_type", "none", "-i", "file:" + frames.string()};
  }
  return {"-start_number", "0", "-i", "file:" + escaped(frames.string()) + "/frame_%04d.png"};
}

}  // namespace

Preview::Preview(std::filesystem::path file, std::string sign, bool force)
    : file_(std::move(file)), sign_(std::move(sign)) {
  if (file_.empty()) return;
  if (!is_video(file_) && io::lower_case_extension(file_) != ".png") {
    throw Failure(ExitCode::kUsage, file_.string() + ": --preview takes *.png, *.gif or *.mp4");
  }
  const OutputFile checked(file_, "", {sign_, force});
  if (is_video(file_) && run_ffmpeg({"-version"}).end == conform::ProcessEnd::kNotStarted) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: GIF and MP4 need the program {}, which is not installed here; "
                              "name a *.png file for an animated PNG",
                              file_.string(), kProgram));
  }
}

void Preview::add(const RgbImage& frame) {
  ++count_;
  if (file_.empty() || is_video(file_) || frames_.size() == kPngFrames) return;
  frames_.push_back(frame);
}

void Preview::write(const std::filesystem::path& folder) const {
  if (file_.empty()) return;
  if (is_video(file_)) return write_video(folder);
  value_or_throw(io::write_apng(file_, frames_, kRate, sign_), ExitCode::kOutput);
}

void Preview::write_video(const std::filesystem::path& folder) const {
  const std::filesystem::path partial = io::partial_name(file_);
  std::vector<std::string> arguments{"-nostdin",   "-loglevel",           "error", "-y",
                                     "-framerate", std::to_string(kRate), "-f",    "image2"};
  for (const auto& part : {input_of(folder), coding_of(file_, count_)}) {
    arguments.insert(arguments.end(), part.begin(), part.end());
  }
  arguments.push_back("file:" + partial.string());
  const conform::ProcessOutcome outcome = run_ffmpeg(std::move(arguments));
  std::error_code failure;
  if (outcome.end == conform::ProcessEnd::kExit && outcome.value == 0) {
    std::filesystem::rename(partial, file_, failure);
    if (!failure) return;
  }
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  throw Failure(ExitCode::kOutput,
                file_.string() + ": " +
                    (failure ? failure.message()
                             : to_string(outcome) + conform::last_words(outcome.messages)));
}

}  // namespace hmlfc::cli
