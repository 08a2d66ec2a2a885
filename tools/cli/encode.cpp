// hmlfc encode: a folder of views to a stream, with the quality measured on the decoded stream.
#include <algorithm>
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
#include "cli/convert_forms.hpp"
#include "cli/divided_encode.hpp"
#include "cli/encode_forecast.hpp"
#include "cli/encode_outcome.hpp"
#include "cli/encode_plan.hpp"
#include "cli/encode_shards.hpp"
#include "cli/rig_options.hpp"
#include "cli/stream_report.hpp"
#include "cli/view_source.hpp"
#include "io/files.hpp"
#include "io/light_field_files.hpp"
#include "terminal/clock.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

// What is encoded.
struct Input {
  LightField field;
  std::optional<ChosenRig> rig;
};

// The views of a quilt or video; a rig names them as hmlfc convert does.
Input load_file(const EncodeOptions& options, terminal::ProgressBar& progress) {
  const int threads = options.coding.params.threads;
  ConvertOptions from;
  from.input = options.input;
  from.naming = options.naming;
  const ConvertInput input = open_input(from);
  const LightFieldShape& shape = input.views->shape();
  Input loaded{all_views(*input.views, threads, progress.callback()), std::nullopt};
  progress.clear();
  if (!options.rig.file) return loaded;
  io::ViewList names{shape.rows, shape.cols, {}};
  for (size_t i = 0; i < size_t{shape.rows} * shape.cols; ++i) {
    const auto [row, col] = io::view_of_frame(i, {shape.rows, shape.cols}, io::FrameOrder::kRaster);
    names.files.emplace_back(io::view_file_name(row, col, shape.rows, shape.cols));
  }
  loaded.rig = rig_for(options.rig, options.coding.params.profile, names, shape);
  return loaded;
}

Input load(const EncodeOptions& options) {
  terminal::ProgressBar progress("Reading", "views");
  if (!options.part && is_one_file(options)) return load_file(options, progress);
  const io::ViewList views = listed_views(options);
  io::Notes notes;
  LightField field = value_or_throw(
      io::load_light_field(views, static_cast<unsigned>(options.coding.params.threads),
                           progress.callback(), &notes),
      ExitCode::kInput);
  progress.clear();
  tell(notes);
  auto rig = rig_for(options.rig, options.coding.params.profile, views, field.shape());
  return {std::move(field), std::move(rig)};
}

EncodedStream encode_input(const Input& input, const EncodeOptions& options,
                           EncodeOutcome& outcome) {
  terminal::ProgressBar progress("Encoding", "images");
  const Clock clock;
  bool told = false;
  const auto on_progress = [&](uint64_t done, uint64_t total) {
    progress.update(done, total);
    if (told || done == 0) return;
    told = 8 * done >= total;
    note_forecast(done, total, clock.wall_seconds(), "images");
  };
  const auto on_forecast = [&](const EncodeForecast& forecast) {
    told = true;
    outcome.forecast = forecast;
    note_forecast(forecast);
  };
  const EncodeParams& params = options.coding.params;
  auto target = target_of(options.coding, input.field.shape());
  if (auto* most = target ? std::get_if<TargetBytes>(&*target) : nullptr; most && input.rig) {
    most->bytes -= std::min(most->bytes - 1, most_rig_bytes(*input.rig));
  }
  auto stream = target ? encode_to(input.field, params, *target, on_progress, on_forecast)
                       : encode(input.field, params, on_progress, on_forecast);
  if (!stream) throw encode_failure(options.input, stream.error());
  if (input.rig) stream->bytes = stream_with_rig(stream->bytes, *input.rig);
  return std::move(*stream);
}

EncodeOutcome encode_and_measure(const EncodeOptions& options) {
  const Input input = load(options);
  const LightField& field = input.field;
  if (seems_transposed(field, options.coding.params.threads)) {
    note(
        fmt::format("{}: views in a row move up and down; if rows and columns are exchanged, use "
                    "--names with {{row}} and {{col}}, or --order",
                    options.input.string()));
  }
  EncodeOutcome outcome;
  ErrorSums promised;
  {
    const Clock clock;
    const EncodedStream stream = encode_input(input, options, outcome);
    outcome.wall_seconds = clock.wall_seconds();
    outcome.cpu_seconds = clock.cpu_seconds();
    outcome.params = stream.params;
    promised = stream.error;
    value_or_throw(io::write_file(options.target, stream.bytes), ExitCode::kOutput);
  }
  const StreamFile file(options.target);
  terminal::ProgressBar progress("Checking", "views");
  const ErrorSums measured =
      measure_stream(file, field, options.coding.params.threads, progress.callback());
  check_promise(promised, measured, options.output.string());
  outcome.quality = quality_of(measured, field.shape());
  outcome.stream = report_on(file);
  outcome.rig = rig_line(file);
  return outcome;
}

ExitCode encode_as_asked(const EncodeOptions& options) {
  if (options.plan) return write_plan(options);
  if (options.shard) return encode_shard(options);
  if (!options.shards.empty()) return tell_outcome(options, assemble_shards(options));
  return tell_outcome(options,
                      options.memory ? encode_in_parts(options) : encode_and_measure(options));
}

// What may be replaced, if the name of the output is that of what is written.
Replacing replacing_of(const EncodeOptions& options) {
  Replacing replacing{kStreamSign, options.force, options.shards};
  replacing.inputs.push_back(options.input);
  if (options.rig.file) replacing.inputs.push_back(*options.rig.file);
  if (options.plan) {
    check_extension(options.output, "a plan", {".json", ".txt"});
    replacing.sign = kPlanSign;
  } else if (options.shard) {
    replacing.sign = kShardSign;
  } else {
    check_extension(options.output, "a stream", {".hmlfc"});
  }
  return replacing;
}

ExitCode run_encode(const EncodeOptions& given) {
  EncodeOptions options = given;
  check_division(options);
  settle_coding_options(*options.app, options.coding);
  const ThreadLimit limit(options.coding.params.threads);
  const OutputFile output(options.output, ".hmlfc", replacing_of(options));
  options.target = output.path();
  const ExitCode code = encode_as_asked(options);
  output.finish();
  return code;
}

}  // namespace

void add_encode(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "encode", "Encode a folder of views", run_encode,
      R"(Profile main has the tools of the paper. It drops blocks whose energy, the sum of the absolute
differences from the prediction, is below --threshold-*; --quality Q means 75 * 2^((60 - Q) / 10). With
--rate-distortion squared errors decide against bits: about a quarter fewer bits at equal PSNR.
Quality lies in [0, 132] and counts in steps of a sample: for the same PSNR, each bit above 8 takes 16
less (main: 10), and the lowest is 16 lower. For --target-psnr the quality told is that of key images.
Profile extended chooses by rate and distortion; without --references it finds the reference groups by
trial, without --chroma the chroma format. Its default --height is 0: key views and motion only.
--preset trades encoding time for size. What takes more than ten seconds has a forecast of time and size
after the trials; without trials one of time, after an eighth of the images or parts.

INPUT may be a quilt, NAME_qsCxRaA.png, or a .y4m video (hmlfc convert --help).

Row and column of a view are the two numbers in its name that make a full grid: 03_04.png,
Camera_03_04_400.0_30.jpg, row03/04.png; a note says which, where there are more. --names tells instead:
{row} and {col} stand for the two, {index} for the number of a sequence, * for any text. Sequences such
as frame_0001.png, and any other names in sorted order, need --grid, and --order unless they go row by
row; input_CamNNN.png (HCI) has a square grid or that of parameters.cfg. With --grid a folder may also
hold a subset of a grid, such as every second row. The stream is the same bytes for any number of
threads.

--views R0..R1:STEP,C0..C1:STEP encodes every STEP-th of rows R0 to R1 and of columns C0 to C1, counted
from 0. :STEP may be left out (1), and one number is one row or column: --views 4,0..16. The folder must
hold the whole grid, but only the files of this part are read.

A stream of profile extended may hold where the cameras stand, its rig, on which no sample depends.
--rig takes JSON as `hmlfc info --rig` prints it, for the whole grid or for --views, the transforms.json
of NeRF and instant-ngp, in which the names in frames[].file_path are those of views, or the
parameters.cfg of the HCI 4D Light Field Benchmark. Without --rig the folder's rig.json is taken, else
its parameters.cfg, else the positions in names out_RR_CC_Y_X_.

After encoding, the file is decoded and compared with the views: the PSNR is that of the decoded file,
from the mean squared error over all views; "inf" (a string in JSON) means no difference. If a target
cannot be met, the nearest stream is kept and the exit status is 6.

--memory bounds what the command holds, whatever the number of views: the light field is encoded part by
part, to the same bytes. What is coded waits in a nameless file beside FILE. Many machines share work
with a plan: --plan settles everything and writes it as JSON, which takes the place of INPUT in --shard
I/N, run for each I from 1 to N, and in --assemble, which puts the shards together. A shard keeps to the
version and the views of its plan.

JSON keys: bytes, bpp, ratio, rows, cols, width, height, profile, method, sections{header, index,
motion, residual, top, other (the rig)}, seconds, psnr_rgb, psnr_y, max_abs_error, cpu_seconds; for
profile main threshold_ref and threshold_pred, for profile extended quality (unless lossless) and
preset; depth; where there were trials, forecast{seconds, bytes}. seconds is the encoding time without
reading, writing and checking.

Examples:
  hmlfc encode views -o chess.hmlfc --target-psnr 40
  hmlfc encode views -o small.hmlfc --target-bpp 0.05
  hmlfc encode views -o paper.hmlfc --profile main --method hmlfc --threshold-pred 50
  hmlfc encode views -o sparse.hmlfc --views 0..8:2,0..8:2
  hmlfc encode lytro -o lytro.hmlfc --grid 9x9 --lossless
  hmlfc encode views -o named.hmlfc --names '{row}_{col}'
  hmlfc encode lytro -o gantry.hmlfc --grid 9x9 --order serpentine
  hmlfc encode views -o posed.hmlfc --rig rig.json
  hmlfc encode views -o large.hmlfc --memory 512M
  hmlfc encode views -o job.json --plan
  hmlfc encode job.json -o 1.part --shard 1/2
  hmlfc encode job.json -o 2.part --shard 2/2
  hmlfc encode job.json -o chess.hmlfc --assemble 1.part 2.part)");
  options.app = &app;
  add_path(app, "INPUT", options.input,
           "Folder of PNG, JPEG, TIFF, WebP, PPM or PGM views, quilt, .y4m or plan");
  add_output(app, options.output, options.force, "FILE",
             "The stream, plan or shard; - for standard output");
  add_naming(app, options.naming);
  add_views(app, options.part);
  add_coding_options(app, options.coding);
  add_rig_options(app, options.rig);
  add_division_options(app, options);
  add_threads(app, options.coding.params.threads);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
