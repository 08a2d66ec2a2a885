// What the accuracy report measures inside a process (bench/accuracy/__main__.py runs it).
//
// Usage: bench_accuracy decode FILE.hmlfc RUNS FOLDER ROW,COL...
//          decodes all views RUNS times; prints as JSON cpu_seconds, the shortest of these runs
//          over all threads, and reference_bytes, the size of the decoded reference images. Then
//          writes the views ROW,COL to FOLDER as RR_CC.png.
//        bench_accuracy frames FILE.hmlfc SOURCE.hmlfc FRAMES SIDE FILTER:LEVELS:CACHE:BACKEND...
//          draws FRAMES square frames of an orbit with each setting, and prints their times and
//          errors as JSON (frame_sweep.hpp). SOURCE decodes to the uncompressed light field;
//          CACHE is MiB of decoded pixels, BACKEND cpu, golden or gpu.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/decoder.hpp>

#include "accuracy/frame_sweep.hpp"
#include "io/mapped_file.hpp"
#include "io/write_image.hpp"
#include "render/timing.hpp"

namespace {

using namespace hmlfc;

constexpr int kUsage = 2;

int refuse(const std::string& message, int status = 1) {
  fmt::print(stderr, "bench_accuracy: {}\n", message);
  return status;
}

std::string write_view(const Decoder& decoder, const std::string& folder, const std::string& text) {
  ViewPos at;
  if (std::sscanf(text.c_str(), "%" SCNu32 ",%" SCNu32, &at.row, &at.col) != 2) {
    return text + ": not ROW,COL";
  }
  const auto view = decoder.decode_view(at);
  if (!view) return text + ": " + to_string(view.error());
  const auto written =
      io::write_png(fmt::format("{}/{:02}_{:02}.png", folder, at.row, at.col), *view);
  return written ? "" : written.error().message;
}

// Each run has a new decoder, which has decoded nothing.
int decode_all(const std::vector<std::string>& arguments) {
  const int runs = std::atoi(arguments[2].c_str());
  if (runs < 1) return refuse("RUNS is not a number from 1 on", kUsage);
  const auto file = io::MappedFile::open(arguments[1]);
  if (!file) return refuse(file.error().message);
  double least = std::numeric_limits<double>::infinity();
  size_t reference_bytes = 0;
  for (int run = 0; run < runs; ++run) {
    const bench::Clock clock;
    const auto decoder = Decoder::open(file->bytes());
    if (!decoder) return refuse(to_string(decoder.error()));
    const auto done = decoder->decode_all([](ViewPos, RgbImage&&) {});
    if (!done) return refuse(to_string(done.error()));
    least = std::min(least, clock.cpu_seconds());
    reference_bytes = decoder->reference_bytes();
    for (size_t k = 4; run == runs - 1 && k < arguments.size(); ++k) {
      const std::string failure = write_view(*decoder, arguments[3], arguments[k]);
      if (!failure.empty()) return refuse(failure);
    }
  }
  const nlohmann::ordered_json json{{"cpu_seconds", least}, {"reference_bytes", reference_bytes}};
  fmt::print("{}\n", json.dump());
  return 0;
}

int draw_frames(const std::vector<std::string>& arguments) {
  bench::FrameSweep sweep;
  sweep.stream = arguments[1];
  sweep.source = arguments[2];
  sweep.frames = std::atoi(arguments[3].c_str());
  sweep.side = static_cast<uint32_t>(std::atoi(arguments[4].c_str()));
  if (sweep.frames < 1) return refuse("FRAMES is not a number from 1 on", kUsage);
  for (size_t k = 5; k < arguments.size(); ++k) {
    const auto setting = bench::parse_frame_setting(arguments[k]);
    if (!setting) return refuse(arguments[k] + ": not FILTER:LEVELS:CACHE:BACKEND", kUsage);
    sweep.settings.push_back(*setting);
  }
  const auto rows = bench::sweep_frames(sweep);
  if (!rows) return refuse(rows.error());
  fmt::print("{}\n", rows->dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() >= 4 && arguments[0] == "decode") {
    return decode_all(arguments);
  }
  if (arguments.size() >= 6 && arguments[0] == "frames") {
    return draw_frames(arguments);
  }
  return refuse(
      "usage: decode FILE RUNS FOLDER ROW,COL..., or "
      "frames FILE SOURCE FRAMES SIDE FILTER:LEVELS:CACHE:BACKEND...",
      kUsage);
}
