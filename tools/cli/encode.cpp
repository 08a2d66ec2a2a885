// hmlfc encode: a folder of views to a stream, with the quality measured on the decoded stream.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <hmlfc/encoder.hpp>

#include "bits/parallel.hpp"
#include "cli/arguments.hpp"
#include "cli/coding_options.hpp"
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/quality.hpp"
#include "cli/stopwatch.hpp"
#include "cli/stream_report.hpp"
#include "cli/view_source.hpp"
#include "io/atomic_file.hpp"
#include "io/light_field_files.hpp"

namespace hmlfc::cli {
namespace {

struct EncodeOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<io::GridShape> grid;
  CodingOptions coding;
  bool json = false;
};

// What an encoding took and gave.
struct EncodeOutcome {
  StreamReport stream;
  Quality quality;
  EncodeParams params;
  Elapsed time;
};

LightField load(const EncodeOptions& options) {
  ProgressBar progress("Reading", "views");
  const auto views = value_or_throw(io::list_views(options.input, options.grid), ExitCode::kInput);
  return value_or_throw(
      io::load_light_field(views, static_cast<unsigned>(options.coding.params.threads),
                           progress.callback()),
      ExitCode::kInput);
}

EncodedStream encode_field(const LightField& field, const EncodeOptions& options) {
  ProgressBar progress("Encoding", "images");
  const EncodeParams& params = options.coding.params;
  const auto target = options.coding.target_psnr;
  auto stream = target ? encode_to_psnr(field, params, *target, progress.callback())
                       : encode(field, params, progress.callback());
  if (!stream)
    throw Failure(ExitCode::kInput, options.input.string() + ": " + stream.error().message);
  return std::move(*stream);
}

// A stream that does not decode to the encoder's own reconstruction is never passed over.
void check_promise(const ErrorSums& promised, const ErrorSums& measured, const std::string& file) {
  if (promised.rgb_squares == measured.rgb_squares && promised.y_squares == measured.y_squares &&
      promised.max_abs == measured.max_abs) {
    return;
  }
  throw Failure(ExitCode::kInternal,
                fmt::format("Internal error: {} does not decode to what the encoder promised "
                            "(squared error over RGB {} instead of {}, over Y {} instead of {}, "
                            "largest error {} instead of {}). The file was kept; please report it.",
                            file, measured.rgb_squares, promised.rgb_squares, measured.y_squares,
                            promised.y_squares, measured.max_abs, promised.max_abs));
}

EncodeOutcome encode_and_measure(const EncodeOptions& options) {
  const LightField field = load(options);
  EncodeOutcome outcome;
  ErrorSums promised;
  {
    const Stopwatch watch;
    const EncodedStream stream = encode_field(field, options);
    outcome.time = watch.elapsed();
    outcome.params = stream.params;
    promised = stream.error;
    value_or_throw(io::write_file(options.output, stream.bytes), ExitCode::kOutput);
  }
  const StreamFile file(options.output);
  ProgressBar progress("Checking", "views");
  const ErrorSums measured =
      measure_stream(file, field, options.coding.params.threads, progress.callback());
  check_promise(promised, measured, options.output.string());
  outcome.quality = quality_of(measured, field.shape());
  outcome.stream = report_on(file);
  return outcome;
}

void print_outcome_json(const EncodeOutcome& outcome) {
  Json json = report_json(outcome.stream);
  json["seconds"] = outcome.time.wall_seconds;
  json["psnr_rgb"] = psnr_json(outcome.quality.psnr_rgb);
  json["psnr_y"] = psnr_json(outcome.quality.psnr_y);
  json["max_abs_error"] = outcome.quality.max_abs_error;
  json["cpu_seconds"] = outcome.time.cpu_seconds;
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
  const LightFieldShape shape{header.rows, header.cols, header.width, header.height, header.depth};
  print(fmt::format("File          {}\nLight field   {}\nCoding        {}\n",
                    options.output.string(), describe(shape), describe_coding(header)));
  print(size_text(outcome.stream));
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
  print(fmt::format("Encoding      {:.2f} s, CPU {:.2f} s\n", outcome.time.wall_seconds,
                    outcome.time.cpu_seconds));
}

ExitCode run_encode(const EncodeOptions& options) {
  const ThreadLimit limit(options.coding.params.threads);
  check_output_file(options.output);
  const EncodeOutcome outcome = encode_and_measure(options);
  const auto target = options.coding.target_psnr;
  if (target && outcome.quality.psnr_rgb < *target) {
    const bool main = outcome.params.profile == Profile::kMain;
    note(fmt::format("Even {} only, less than the {} dB asked for{}",
                     fmt::format("{} {}", main ? "thresholds of 0 give" : "quality 100 gives",
                                 psnr_text(outcome.quality.psnr_rgb)),
                     *target,
                     outcome.params.chroma == ChromaFormat::k420
                         ? ": halved chroma costs the rest; --chroma 444 keeps it"
                         : ""));
  }
  if (options.json) {
    print_outcome_json(outcome);
  } else {
    print_outcome_text(options, outcome);
  }
  return ExitCode::kDone;
}

}  // namespace

void add_encode(CLI::App& program, Task& task) {
  const auto options = std::make_shared<EncodeOptions>();
  CLI::App* app = program.add_subcommand("encode", "Encode a folder of views");
  add_path(*app, "INPUT", options->input, "Folder of PNG, PPM, PGM or JPEG views");
  add_output(*app, options->output, "FILE", "The .hmlfc file to write");
  add_grid(*app, options->grid);
  add_coding_options(*app, options->coding);
  add_threads(*app, options->coding.params.threads);
  app->add_flag("--json", options->json, "Print JSON");
  app->footer(
      R"(Profile main has the tools of the paper; --threshold-* belong to it: blocks whose energy, the sum of
the absolute differences from the prediction, is below them are dropped. --quality sets both to
75 * 2^((60 - Q) / 10) there. Profile extended chooses everything by rate and distortion; without
--references it finds the groups, and without --chroma the format, by trial. Its tree has --height 0
unless told otherwise: key views and motion. --preset trades its time for bits.

Views are told by their names: RR_CC.png, out_RR_CC_Y_X_.png, input_CamNNN.png; any other names in
sorted order, row by row, with --grid. The stream is the same bytes for any number of threads.

After encoding, the written file is decoded and compared with the views: the PSNR printed is that of
the decoded file. PSNR is that of the mean squared error over all views; "inf" (a string in JSON, too)
means that nothing differs.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other}, seconds, psnr_rgb, psnr_y, max_abs_error; then cpu_seconds; then
threshold_ref, threshold_pred in profile main, quality, preset in profile extended. seconds is the time
of encoding without reading, writing and checking.

Examples:
  hmlfc encode views -o chess.hmlfc --target-psnr 40
  hmlfc encode views -o paper.hmlfc --profile main --method hmlfc --threshold-pred 50
  hmlfc encode lytro -o lytro.hmlfc --grid 9x9 --lossless)");
  app->callback([&task, app, options] {
    task = [app, options] {
      settle_coding_options(*app, options->coding);
      return run_encode(*options);
    };
  });
}

}  // namespace hmlfc::cli
