#include "cli/encode_outcome.hpp"

#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/convert_forms.hpp"
#include "cli/view_source.hpp"
#include "io/files.hpp"

namespace hmlfc::cli {
namespace {

Json outcome_json(const EncodeOutcome& outcome) {
  Json json = report_json(outcome.stream);
  json["depth"] = outcome.stream.header.depth;  // of what is compared below
  json["seconds"] = outcome.wall_seconds;
  json["psnr_rgb"] = psnr_json(outcome.quality.psnr_rgb);
  json["psnr_y"] = psnr_json(outcome.quality.psnr_y);
  json["max_abs_error"] = outcome.quality.max_abs_error;
  json["cpu_seconds"] = outcome.cpu_seconds;
  if (outcome.params.profile == Profile::kMain) {
    json["threshold_ref"] = outcome.params.main.threshold_ref;
    json["threshold_pred"] = outcome.params.main.threshold_pred;
  } else {
    if (!outcome.params.lossless) json["quality"] = outcome.params.extended.quality;
    json["preset"] = preset_name(outcome.params.extended.preset);
  }
  if (const auto& forecast = outcome.forecast) {
    json["forecast"] = {{"seconds", forecast->seconds}, {"bytes", std::round(forecast->bytes)}};
  }
  return json;
}

std::string outcome_text(const EncodeOptions& options, const EncodeOutcome& outcome) {
  const StreamHeader& header = outcome.stream.header;
  std::string text = fmt::format(
      "File          {}\nLight field   {}\nCoding        {}\n{}{}"
      "Quality       PSNR RGB {}, Y {}, largest error {}\n",
      options.output.string(), describe(shape_of(header)), describe_coding(header),
      size_text(outcome.stream), outcome.rig, psnr_text(outcome.quality.psnr_rgb),
      psnr_text(outcome.quality.psnr_y), outcome.quality.max_abs_error);
  if (outcome.params.profile == Profile::kMain) {
    text += fmt::format("Thresholds    {} reference, {} predictive images\n",
                        outcome.params.main.threshold_ref, outcome.params.main.threshold_pred);
  } else if (!outcome.params.lossless) {
    text += fmt::format("Coded at      quality {}, preset {}\n", outcome.params.extended.quality,
                        preset_name(outcome.params.extended.preset));
  }
  return text + fmt::format("Encoding      {:.2f} s, CPU {:.2f} s\n", outcome.wall_seconds,
                            outcome.cpu_seconds);
}

// Says that and why --target-psnr was not reached.
void note_missed_psnr(double target, const EncodeOutcome& outcome) {
  const bool main = outcome.params.profile == Profile::kMain;
  note(fmt::format("--target-psnr {} was not reached: even {} {} only{}", target,
                   main ? "thresholds of 0 give" : "quality 132 gives",
                   psnr_text(outcome.quality.psnr_rgb),
                   outcome.stream.header.chroma_format == ChromaFormat::k420
                       ? "; half-size chroma may limit it, try --chroma 444"
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
  note(fmt::format(
      "{} bytes were not enough: the smallest stream found has {}; encode fewer or smaller "
      "views{}",
      most, outcome.stream.bytes,
      outcome.params.profile == Profile::kMain ? ", or in profile extended" : ""));
  return false;
}

}  // namespace

bool is_one_file(const EncodeOptions& options) {
  return (io::is_picture_name(options.input) || is_video(options.input)) &&
         !std::filesystem::is_directory(options.input);
}

io::ViewList listed_views(const EncodeOptions& options) {
  if (is_one_file(options)) {
    throw Failure(ExitCode::kUsage, fmt::format("{}: --views, --memory and --plan need a folder of "
                                                "views; hmlfc convert makes one",
                                                options.input.string()));
  }
  std::error_code ignored;
  if (io::lower_case_extension(options.input) == ".json" &&
      std::filesystem::is_regular_file(options.input, ignored)) {
    throw Failure(
        ExitCode::kUsage,
        options.input.string() +
            ": not a folder of views; --shard I/N and --assemble take a plan, --rig a rig");
  }
  auto views = views_in(options.input, options.naming);
  if (!options.part) return views;
  return value_or_throw(io::part_of(options.input, views, *options.part), ExitCode::kInput);
}

Failure encode_failure(const std::filesystem::path& input, const EncodeError& error) {
  return Failure(error.out_of_memory ? ExitCode::kOutOfMemory : ExitCode::kInput,
                 input.string() + ": " + error.message);
}

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

ExitCode tell_outcome(const EncodeOptions& options, const EncodeOutcome& outcome) {
  print_result(options.json, outcome_json(outcome), outcome_text(options, outcome));
  const int asked = options.coding.params.tree_height.value_or(0);
  if (const int height = outcome.stream.header.tree_height; asked > height) {
    note(fmt::format("--height {}: beyond {} no images are left to join", asked, height));
  }
  return is_on_target(options, outcome) ? ExitCode::kDone : ExitCode::kMissed;
}

}  // namespace hmlfc::cli
