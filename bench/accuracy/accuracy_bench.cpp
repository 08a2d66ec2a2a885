// What the accuracy report measures inside a process (bench/accuracy/__main__.py runs it).
//
// Usage: bench_accuracy decode FILE.hmlfc RUNS FOLDER ROW,COL...
//          decodes all views, RUNS times; prints as JSON cpu_seconds, the least of a decoding over
//          all threads, and reference_bytes, the decoded sparse reference images. Then writes these
//          views to FOLDER as RR_CC.png.
//        bench_accuracy frames FILE.hmlfc SOURCE.hmlfc FRAMES SIDE FILTER:LEVELS:CACHE:BACKEND...
//          draws FRAMES square frames of an orbit with each setting, and prints what they took and
//          their errors as JSON (frame_sweep.hpp). SOURCE decodes to the uncompressed light field;
//          CACHE is MiB of decoded pixels, BACKEND cpu, golden or gpu.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/decoder.hpp>

#include "accuracy/frame_sweep.hpp"
#include "common/program.hpp"
#include "io/files.hpp"
#include "io/image_files.hpp"
#include "terminal/clock.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;

void write_view(const Decoder& decoder, const std::string& folder, const std::string& text) {
  ViewPos at;
  if (std::sscanf(text.c_str(), "%" SCNu32 ",%" SCNu32, &at.row, &at.col) != 2) {
    throw std::invalid_argument(text + ": not ROW,COL");
  }
  const auto file = fmt::format("{}/{:02}_{:02}.png", folder, at.row, at.col);
  value_of(io::write_png(file, value_of(decoder.decode_view(at))));
}

// A decoder of its own for each run, so that nothing is decoded already.
nlohmann::ordered_json decode_all(const std::vector<std::string>& arguments) {
  const auto file = value_of(io::map_file(arguments[1]));
  double least = std::numeric_limits<double>::infinity();
  std::optional<Decoder> decoder;
  for (int run = 0; run < std::max(std::stoi(arguments[2]), 1); ++run) {
    const Clock clock;
    decoder = value_of(Decoder::open(file.bytes()));
    value_of(decoder->decode_all([](ViewPos, RgbImage&&) {}));
    least = std::min(least, clock.cpu_seconds());
  }
  for (size_t k = 4; k < arguments.size(); ++k) write_view(*decoder, arguments[3], arguments[k]);
  return {{"cpu_seconds", least}, {"reference_bytes", decoder->reference_bytes()}};
}

nlohmann::ordered_json draw_frames(const std::vector<std::string>& arguments) {
  bench::FrameSweep sweep;
  sweep.stream = arguments[1];
  sweep.source = arguments[2];
  sweep.frames = std::max(std::stoi(arguments[3]), 1);
  sweep.side = static_cast<uint32_t>(std::stoi(arguments[4]));
  for (size_t k = 5; k < arguments.size(); ++k) {
    sweep.settings.push_back(bench::parse_frame_setting(arguments[k]));
  }
  return bench::sweep_frames(sweep);
}

int run(const std::vector<std::string>& arguments) {
  nlohmann::ordered_json made;
  if (arguments.size() >= 4 && arguments[0] == "decode") {
    made = decode_all(arguments);
  } else if (arguments.size() >= 6 && arguments[0] == "frames") {
    made = draw_frames(arguments);
  } else {
    throw std::invalid_argument(
        "usage: decode FILE RUNS FOLDER ROW,COL..., or "
        "frames FILE SOURCE FRAMES SIDE FILTER:LEVELS:CACHE:BACKEND...");
  }
  fmt::print("{}\n", made.dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_accuracy", [&] { return run({argv + 1, argv + argc}); });
}
