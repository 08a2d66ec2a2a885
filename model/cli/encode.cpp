// hmlfc encode: a folder of views to a stream, with the quality measured on the decoded stream.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <hmlfc/encoder.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/quality.hpp"
#include "cli/stopwatch.hpp"
#include "cli/stream_report.hpp"
#include "cli/thread_limit.hpp"
#include "cli/view_source.hpp"
#include "io/atomic_file.hpp"
#include "io/light_field_files.hpp"

namespace hmlfc::cli {
namespace {

struct EncodeOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<io::GridShape> grid;
  Profile profile = Profile::kMain;
  EncodeParams params;
  std::optional<double> target_psnr;
  bool lossless = false;
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
  return value_or_throw(io::load_light_field(views, static_cast<unsigned>(options.params.threads),
                                             progress.callback()),
                        ExitCode::kInput);
}

EncodedStream encode_field(const LightField& field, const EncodeOptions& options) {
  ProgressBar progress("Encoding", "images");
  EncodeParams params = options.params;
  if (options.lossless) {
    params.chroma = ChromaFormat::k444;
    params.threshold_ref = 0;
    params.threshold_pred = 0;
  }
  auto stream = options.target_psnr
                    ? encode_to_psnr(field, params, *options.target_psnr, progress.callback())
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
      measure_stream(file, field, options.params.threads, progress.callback());
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
  json["threshold_ref"] = outcome.params.threshold_ref;
  json["threshold_pred"] = outcome.params.threshold_pred;
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
  print(fmt::format("Thresholds    {} reference, {} predictive images\n",
                    outcome.params.threshold_ref, outcome.params.threshold_pred));
  print(fmt::format("Encoding      {:.2f} s, CPU {:.2f} s\n", outcome.time.wall_seconds,
                    outcome.time.cpu_seconds));
}

ExitCode run_encode(const EncodeOptions& options) {
  const ThreadLimit limit(options.params.threads);
  check_output_file(options.output);
  const EncodeOutcome outcome = encode_and_measure(options);
  if (options.target_psnr && outcome.quality.psnr_rgb < *options.target_psnr) {
    note(fmt::format("Even thresholds of 0 give {} only, less than the {} dB asked for{}",
                     psnr_text(outcome.quality.psnr_rgb), *options.target_psnr,
                     options.params.chroma == ChromaFormat::k420
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

// Refuses combinations that contradict each other.
void check(const CLI::App& app, const EncodeOptions& options) {
  const auto given = [&app](const char* name) { return app.get_option(name)->count() > 0; };
  const auto refuse = [](const std::string& message) {
    throw Failure(ExitCode::kUsage, "hmlfc encode: " + message);
  };
  const bool thresholds = given("--threshold-ref") || given("--threshold-pred");
  if (options.target_psnr && thresholds) refuse("--target-psnr chooses the thresholds itself");
  if (options.lossless && options.target_psnr)
    refuse("--lossless and --target-psnr exclude each other");
  if (options.lossless && thresholds) refuse("--lossless sets the thresholds to 0 itself");
  if (options.lossless && given("--chroma") && options.params.chroma == ChromaFormat::k420) {
    refuse("--lossless needs --chroma 444");
  }
  const Method method = options.params.method;
  if (method == Method::kMc && given("--height") && options.params.tree_height != 0) {
    refuse("--method mc has no tree: its height is 0");
  }
  if (method == Method::kRlfc && (given("--window") || given("--references"))) {
    refuse("--method rlfc has no motion: --window and --references do not apply");
  }
}

void add_coding_options(CLI::App& app, EncodeParams& params) {
  add_choice(app, "--method", params.method,
             {{"hmlfc", Method::kHmlfc}, {"rlfc", Method::kRlfc}, {"mc", Method::kMc}},
             "Tree and motion, tree only, or motion only")
      ->default_str("hmlfc");
  add_rows_by_cols(app, "--cluster", params.cluster_rows, params.cluster_cols, 255,
                   "Images that share a parent, rows x columns");
  add_integer(app, "--height", params.tree_height, 0, 15, "Levels of the tree above the views");
  add_choice(app, "--block", params.block_size, {{"2", 2u}, {"4", 4u}, {"8", 8u}},
             "Samples along the side of a block")
      ->default_str(std::to_string(params.block_size));
  add_integer(app, "--window", params.window, 0, 127,
              "Largest motion vector component, in samples");
  add_rows_by_cols(app, "--references", params.ref_rows, params.ref_cols, 255,
                   "Images that share a reference image, rows x columns");
  add_integer(app, "--threshold-ref", params.threshold_ref, 0, 1u << 20,
              "Blocks of less energy are dropped in reference images");
  add_integer(app, "--threshold-pred", params.threshold_pred, 0, 1u << 20,
              "The same in predictive images");
  add_choice(app, "--chroma", params.chroma,
             {{"420", ChromaFormat::k420}, {"444", ChromaFormat::k444}},
             "Chroma at half width and height, or in full")
      ->default_str("420");
}

}  // namespace

void add_encode(CLI::App& program, Task& task) {
  const auto options = std::make_shared<EncodeOptions>();
  CLI::App* app = program.add_subcommand("encode", "Encode a folder of views");
  add_path(*app, "INPUT", options->input, "Folder of PNG, PPM, PGM or JPEG views");
  add_output(*app, options->output, "FILE", "The .hmlfc file to write");
  add_grid(*app, options->grid);
  add_choice(*app, "--profile", options->profile, {{"main", Profile::kMain}},
             "Profile of the stream")
      ->default_str("main");
  add_coding_options(*app, options->params);
  add_decimal(*app, "--target-psnr", "DB", options->target_psnr, 1, 100,
              "Find the thresholds that give this PSNR over RGB");
  app->add_flag("--lossless", options->lossless, "Keep every RGB value: thresholds 0, chroma 444");
  add_threads(*app, options->params.threads);
  app->add_flag("--json", options->json, "Print JSON");
  app->footer(
      R"(Energy is the sum of the absolute differences from the prediction. --height is lowered to what the
grid needs.

Views are told by their names: RR_CC.png, out_RR_CC_Y_X_.png, input_CamNNN.png; any other names in
sorted order, row by row, with --grid. The stream is the same bytes for any number of threads.

After encoding, the written file is decoded and compared with the views: the PSNR printed is that of
the decoded file. PSNR is that of the mean squared error over all views; "inf" (a string in JSON, too)
means that nothing differs.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other}, seconds, psnr_rgb, psnr_y, max_abs_error; then cpu_seconds,
threshold_ref, threshold_pred. seconds is the time of encoding without reading, writing and checking.

Examples:
  hmlfc encode views -o chess.hmlfc --target-psnr 40
  hmlfc encode lytro -o lytro.hmlfc --grid 9x9 --lossless)");
  app->callback([&task, app, options] {
    task = [app, options] {
      check(*app, *options);
      return run_encode(*options);
    };
  });
}

}  // namespace hmlfc::cli
