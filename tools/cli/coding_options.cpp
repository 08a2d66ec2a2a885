#include "cli/coding_options.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.hpp"

namespace hmlfc::cli {
namespace {

const std::vector<std::pair<std::string, Preset>> kPresets{
    {"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}};

// Refuses combinations that contradict each other.
void check(const CLI::App& app, const CodingOptions& options) {
  const EncodeParams& params = options.params;
  const auto given = [&](const char* name) { return app.get_option(name)->count() > 0; };
  const bool thresholds = given("--threshold-ref") || given("--threshold-pred");
  const bool main = params.profile == Profile::kMain;
  const int targets =
      (options.target_psnr ? 1 : 0) + (options.target_bpp ? 1 : 0) + (options.max_bytes ? 1 : 0);
  const std::string target = options.target_psnr  ? "--target-psnr"
                             : options.target_bpp ? "--target-bpp"
                                                  : "--max-bytes";
  const bool motion = given("--window") || given("--references");
  const std::pair<bool, std::string> rules[] = {
      {targets > 1, "--target-psnr, --target-bpp and --max-bytes exclude each other"},
      {targets > 0 && thresholds, target + " chooses the thresholds itself"},
      {options.quality && thresholds, "--quality chooses the thresholds itself"},
      {options.quality && targets > 0, target + " chooses the quality itself"},
      {params.lossless && targets > 0, "--lossless and " + target + " exclude each other"},
      {params.lossless && options.quality, "--lossless and --quality exclude each other"},
      {params.lossless && thresholds, "--lossless sets the thresholds to 0 itself"},
      {params.lossless && params.chroma == ChromaFormat::k420, "--lossless needs --chroma 444"},
      {thresholds && !main, "--threshold-ref and --threshold-pred need --profile main"},
      {main && given("--preset"), "--preset needs --profile extended"},
      {params.main.rate_distortion && !main, "--rate-distortion needs --profile main"},
      {params.method == Method::kMc && given("--height") && params.tree_height != 0,
       "--method mc has no tree: its height is 0"},
      {given("--cluster") &&
           (params.method == Method::kMc || params.tree_height.value_or(main ? 1 : 0) == 0),
       "--cluster is of a tree: it needs --height 1 or more"},
      {params.method == Method::kRlfc && motion,
       "--method rlfc has no motion: --window and --references do not apply"}};
  for (const auto& [broken, message] : rules) {
    if (broken) throw Failure(ExitCode::kUsage, "hmlfc encode: " + message);
  }
}

void add_main_options(CLI::App& app, EncodeParams& params) {
  add_integer(app, "--threshold-ref", params.main.threshold_ref, 0, 1u << 20,
              "Main: minimum block energy, reference images");
  add_integer(app, "--threshold-pred", params.main.threshold_pred, 0, 1u << 20,
              "Main: minimum block energy, predictive images");
  app.add_flag("--rate-distortion", params.main.rate_distortion,
               "Main: decide by squared error and bits, fewer bits");
}

void add_structure_options(CLI::App& app, CodingOptions& options) {
  EncodeParams& params = options.params;
  add_choice(app, "--method", params.method,
             {{"hmlfc", Method::kHmlfc}, {"rlfc", Method::kRlfc}, {"mc", Method::kMc}},
             "Tree and motion, tree only, or motion only")
      ->default_str("hmlfc");
  add_rows_by_cols(app, "--cluster", params.cluster_rows, params.cluster_cols, 255,
                   "Images that share a parent");
  add_integer(app, "--height", params.tree_height, 0, 15,
              "Levels of the tree above the views (main 3, extended 0)");
  add_choice(app, "--block", params.block_size, {{"2", 2u}, {"4", 4u}, {"8", 8u}},
             "Block size, samples")
      ->default_str(std::to_string(params.block_size));
  add_integer(app, "--window", params.window, 0, 127,
              "Largest vector component, samples (main 16, extended 64)");
  add_rows_by_cols(app, "--references", params.ref_rows, params.ref_cols, 255,
                   "Images that share a reference image (main 8x8)")
      ->default_str("");
  add_choice(
      app, "--chroma", params.chroma,
      {{"420", std::optional(ChromaFormat::k420)}, {"444", std::optional(ChromaFormat::k444)}},
      "Chroma at half or full resolution (main 420 unless for a PSNR)")
      ->default_str("");
}

}  // namespace

std::string_view preset_name(Preset preset) {
  const auto found = std::ranges::find(kPresets, preset, &std::pair<std::string, Preset>::second);
  return found->first;
}

void add_coding_options(CLI::App& app, CodingOptions& options) {
  add_choice(app, "--profile", options.params.profile,
             {{"main", Profile::kMain}, {"extended", Profile::kExtended}}, "Profile of the stream")
      ->default_str("extended");
  add_decimal(app, "--quality", "Q", options.quality, -64, kHighestQuality,
              "Higher is better and larger (default 60)");
  add_decimal(app, "--target-psnr", "DB", options.target_psnr, 1, 100,
              "Find the lowest quality with this PSNR over RGB");
  add_decimal(app, "--target-bpp", "B", options.target_bpp, 1e-6, 1000,
              "Find the highest quality with at most B bits per pixel");
  add_integer(app, "--max-bytes", options.max_bytes, 1, uint64_t{1} << 62,
              "Find the highest quality with at most N bytes");
  app.add_flag("--lossless", options.params.lossless,
               "Keep every RGB value (of up to 12 bits); implies --chroma 444");
  add_choice(app, "--preset", options.params.extended.preset, kPresets,
             "Extended: how long to search for the best coding")
      ->default_str("medium");
  add_structure_options(app, options);
  add_main_options(app, options.params);
}

std::optional<EncodeTarget> target_of(const CodingOptions& options, const LightFieldShape& shape) {
  if (options.target_psnr) return TargetPsnr{*options.target_psnr};
  if (options.max_bytes) return TargetBytes{*options.max_bytes};
  if (!options.target_bpp) return std::nullopt;
  const double pixels = static_cast<double>(shape.rows) * shape.cols * shape.width * shape.height;
  const double bytes = std::floor(*options.target_bpp * pixels / 8);
  return TargetBytes{std::max<uint64_t>(1, static_cast<uint64_t>(bytes))};
}

void settle_coding_options(const CLI::App& app, CodingOptions& options) {
  check(app, options);
  if (!options.quality) return;
  options.params.extended.quality = *options.quality;
  options.params.main.threshold_ref = threshold_of_quality(*options.quality);
  options.params.main.threshold_pred = options.params.main.threshold_ref;
}

}  // namespace hmlfc::cli
