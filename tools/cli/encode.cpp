// hmlfc encode: a folder of views to a stream, with the quality measured on the decoded stream.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/encoder.hpp>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/coding_options.hpp"
#include "cli/comparison.hpp"
#include "cli/rig_options.hpp"
#include "cli/stream_report.hpp"
#include "cli/view_source.hpp"
#include "io/files.hpp"
#include "io/light_field_files.hpp"
#include "io/view_part.hpp"
#include "terminal/clock.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

struct EncodeOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<io::GridShape> grid;
  std::optional<io::ViewPart> part;
  CodingOptions coding;
  RigOptions rig;
  bool json = false;
  const CLI::App* app = nullptr;  ///< tells which options were given
};

// What is encoded.
struct Input {
  LightField field;
  std::optional<ChosenRig> rig;
};

// The result of encoding, and its cost.
struct EncodeOutcome {
  StreamReport stream;
  Quality quality;
  EncodeParams params;
  std::string rig;  ///< rig_line()
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< of all threads of the process
};

Input load(const EncodeOptions& options) {
  terminal::ProgressBar progress("Reading", "views");
  auto views = value_or_throw(io::list_views(options.input, options.grid), ExitCode::kInput);
  if (options.part) {
    views = value_or_throw(io::part_of(options.input, views, *options.part), ExitCode::kInput);
  }
  io::ImageLosses losses;
  LightField field = value_or_throw(
      io::load_light_field(views, static_cast<unsigned>(options.coding.params.threads),
                           progress.callback(), &losses),
      ExitCode::kInput);
  progress.clear();
  note_losses(options.input, losses);
  auto rig = rig_for(options.rig, options.coding.params.profile, views, field.shape());
  return {std::move(field), std::move(rig)};
}

EncodedStream encode_input(const Input& input, const EncodeOptions& options) {
  terminal::ProgressBar progress("Encoding", "images");
  const EncodeParams& params = options.coding.params;
  auto target = target_of(options.coding, input.field.shape());
  if (auto* most = target ? std::get_if<TargetBytes>(&*target) : nullptr; most && input.rig) {
    most->bytes -= std::min(most->bytes - 1, most_rig_bytes(*input.rig));
  }
  auto stream = target ? encode_to(input.field, params, *target, progress.callback())
                       : encode(input.field, params, progress.callback());
  if (!stream)
    throw Failure(ExitCode::kInput, options.input.string() + ": " + stream.error().message);
  if (input.rig) stream->bytes = stream_with_rig(stream->bytes, *input.rig);
  return std::move(*stream);
}

// Fails unless the stream decodes to the encoder's own reconstruction.
void check_promise(const ErrorSums& promised, const ErrorSums& measured, const std::string& file) {
  if (promised.rgb_squares == measured.rgb_squares && promised.y_squares == measured.y_squares &&
      promised.max_abs == measured.max_abs) {
    return;
  }
  throw Failure(ExitCode::kInternal,
                fmt::format("Internal error: {} does not decode to the encoder's reconstruction "
                            "(squared error over RGB {} instead of {}, over Y {} instead of {}, "
                            "largest error {} instead of {}). The file was kept; please report it.",
                            file, measured.rgb_squares, promised.rgb_squares, measured.y_squares,
                            promised.y_squares, measured.max_abs, promised.max_abs));
}

EncodeOutcome encode_and_measure(const EncodeOptions& options) {
  const Input input = load(options);
  const LightField& field = input.field;
  EncodeOutcome outcome;
  ErrorSums promised;
  {
    const Clock clock;
    const EncodedStream stream = encode_input(input, options);
    outcome.wall_seconds = clock.wall_seconds();
    outcome.cpu_seconds = clock.cpu_seconds();
    outcome.params = stream.params;
    promised = stream.error;
    value_or_throw(io::write_file(options.output, stream.bytes), ExitCode::kOutput);
  }
  const StreamFile file(options.output);
  terminal::ProgressBar progress("Checking", "views");
  const ErrorSums measured =
      measure_stream(file, field, options.coding.params.threads, progress.callback());
  check_promise(promised, measured, options.output.string());
  outcome.quality = quality_of(measured, field.shape());
  outcome.stream = report_on(file);
  outcome.rig = rig_line(file);
  return outcome;
}

void print_outcome_json(const EncodeOutcome& outcome) {
  Json json = report_json(outcome.stream);
  json["seconds"] = outcome.wall_seconds;
  json["psnr_rgb"] = psnr_json(outcome.quality.psnr_rgb);
  json["psnr_y"] = psnr_json(outcome.quality.psnr_y);
  json["max_abs_error"] = outcome.quality.max_abs_error;
  json["cpu_seconds"] = outcome.cpu_seconds;
  if (outcome.params.profile == Profile::kMain) {
    json["threshold_ref"] = outcome.params.main.threshold_ref;
    json["threshold_pred"] = outcome.params.main.threshold_pred;
  } else {
    json["quality"] = outcome.params.extended.quality;
    json["preset"] = preset_name(outcome.params.extended.preset);
  }
  print_json(json);
}

void print_outcome_text(const EncodeOptions& options, const EncodeOutcome& outcome) {
  const StreamHeader& header = outcome.stream.header;
  print(fmt::format("File          {}\nLight field   {}\nCoding        {}\n",
                    options.output.string(), describe(shape_of(header)), describe_coding(header)));
  print(size_text(outcome.stream) + outcome.rig);
  print(fmt::format("Quality       PSNR RGB {}, Y {}, largest error {}\n",
                    psnr_text(outcome.quality.psnr_rgb), psnr_text(outcome.quality.psnr_y),
                    outcome.quality.max_abs_error));
  if (outcome.params.profile == Profile::kMain) {
    print(fmt::format("Thresholds    {} reference, {} predictive images\n",
                      outcome.params.main.threshold_ref, outcome.params.main.threshold_pred));
  } else if (!outcome.params.lossless) {
    print(fmt::format("Coded at      quality {}, preset {}\n", outcome.params.extended.quality,
                      preset_name(outcome.params.extended.preset)));
  }
  print(fmt::format("Encoding      {:.2f} s, CPU {:.2f} s\n", outcome.wall_seconds,
                    outcome.cpu_seconds));
}

// Says that and why --target-psnr was not reached.
void note_missed_psnr(double target, const EncodeOutcome& outcome) {
  const bool main = outcome.params.profile == Profile::kMain;
  note(fmt::format("--target-psnr {} was not reached: even {} {} only{}", target,
                   main ? "thresholds of 0 give" : "quality 100 gives",
                   psnr_text(outcome.quality.psnr_rgb),
                   outcome.stream.header.chroma_format == ChromaFormat::k420
                       ? "; half-size chroma limits it, try --chroma 444"
                       : "; --lossless keeps every value"));
}

// Whether the target was met, if there is one; says how far the encoding got if not.
bool is_on_target(const EncodeOptions& options, const EncodeOutcome& outcome) {
  const auto target = target_of(options.coding, shape_of(outcome.stream.header));
  if (!target) return true;
  if (const auto* least = std::get_if<TargetPsnr>(&*target)) {
    if (outcome.quality.psnr_rgb >= least->db) return true;
    note_missed_psnr(least->db, outcome);
    return false;
  }
  const uint64_t most = std::get<TargetBytes>(*target).bytes;
  if (outcome.stream.bytes <= most) return true;
  note(
      fmt::format("{} bytes were not enough: the smallest stream has {}; encode fewer or smaller "
                  "views, or try larger --references",
                  most, outcome.stream.bytes));
  return false;
}

ExitCode run_encode(const EncodeOptions& given) {
  EncodeOptions options = given;
  settle_coding_options(*options.app, options.coding);
  const ThreadLimit limit(options.coding.params.threads);
  check_output_file(options.output);
  const EncodeOutcome outcome = encode_and_measure(options);
  if (options.json) {
    print_outcome_json(outcome);
  } else {
    print_outcome_text(options, outcome);
  }
  return is_on_target(options, outcome) ? ExitCode::kDone : ExitCode::kMissed;
}

}  // namespace

void add_encode(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "encode", "Encode a folder of views", run_encode,
      R"(Profile main has the tools of the paper. It drops blocks whose energy, the sum of the absolute
differences from the prediction, is below --threshold-*; --quality Q means 75 * 2^((60 - Q) / 10).
Profile extended chooses by rate and distortion; without --references it finds the reference groups by
trial, without --chroma the chroma format. Its default --height is 0: key views and motion only.
--preset trades encoding time for size.

View positions are parsed from file names: RR_CC.png, out_RR_CC_Y_X_.png, input_CamNNN.png. Files with
other names are taken in sorted order, row by row, and need --grid. With --grid a folder may also hold
a subset of a grid, such as every second row. The stream is the same bytes for any number of threads.

--views R0..R1:STEP,C0..C1:STEP encodes every STEP-th of rows R0 to R1 and of columns C0 to C1, counted
from 0. :STEP may be left out (1), and one number is one row or column: --views 4,0..16. The folder must
hold the whole grid, but only the files of this part are read.

A stream of profile extended may hold where the cameras stand, its rig, on which no sample depends.
Names out_RR_CC_Y_X_ give positions. --rig takes JSON as `hmlfc info --rig` prints it, or the
transforms.json of NeRF and instant-ngp, in which the names in frames[].file_path are those of views.

After encoding, the file is decoded and compared with the views: the PSNR is that of the decoded file,
from the mean squared error over all views; "inf" (a string in JSON) means no difference. If a target
cannot be met, the nearest stream is kept and the exit status is 6.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other (the rig)}, seconds, psnr_rgb, psnr_y, max_abs_error, cpu_seconds; for
profile main threshold_ref and threshold_pred, for profile extended quality and preset. seconds is the
encoding time without reading, writing and checking.

Examples:
  hmlfc encode views -o chess.hmlfc --target-psnr 40
  hmlfc encode views -o small.hmlfc --target-bpp 0.05
  hmlfc encode views -o paper.hmlfc --profile main --method hmlfc --threshold-pred 50
  hmlfc encode views -o sparse.hmlfc --views 0..8:2,0..8:2
  hmlfc encode lytro -o lytro.hmlfc --grid 9x9 --lossless
  hmlfc encode views -o posed.hmlfc --rig rig.json)");
  options.app = &app;
  add_path(app, "INPUT", options.input, "Folder of PNG, PPM, PGM or JPEG views");
  add_output(app, options.output, "FILE", "The .hmlfc file to write");
  add_grid(app, options.grid);
  add_views(app, options.part);
  add_coding_options(app, options.coding);
  add_rig_options(app, options.rig);
  add_threads(app, options.coding.params.threads);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
