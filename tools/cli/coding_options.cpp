#include "cli/coding_options.hpp"

#include <cmath>
#include <string>

#include "cli/arguments.hpp"

namespace hmlfc::cli {
namespace {

class Settler {
 public:
  Settler(const CLI::App& app, CodingOptions& options)
      : app_(app), options_(options), params_(options.params) {}

  void run() {
    check_quality();
    check_method();
    if (options_.quality) set_quality(*options_.quality);
  }

 private:
  bool given(const char* name) const { return app_.get_option(name)->count() > 0; }

  [[noreturn]] static void refuse(const std::string& message) {
    throw Failure(ExitCode::kUsage, "hmlfc encode: " + message);
  }

  void check_quality() const {
    const bool thresholds = given("--threshold-ref") || given("--threshold-pred");
    const bool main = params_.profile == Profile::kMain;
    if (options_.target_psnr && thresholds) refuse("--target-psnr chooses the thresholds itself");
    if (options_.quality && thresholds) refuse("--quality chooses the thresholds itself");
    if (options_.quality && options_.target_psnr)
      refuse("--target-psnr chooses the quality itself");
    if (params_.lossless && options_.target_psnr) {
      refuse("--lossless and --target-psnr exclude each other");
    }
    if (params_.lossless && options_.quality) refuse("--lossless and --quality exclude each other");
    if (params_.lossless && thresholds) refuse("--lossless sets the thresholds to 0 itself");
    if (params_.lossless && params_.chroma == ChromaFormat::k420) {
      refuse("--lossless needs --chroma 444");
    }
    if (thresholds && !main) refuse("--threshold-ref and --threshold-pred need --profile main");
    if (main && given("--preset")) refuse("--preset needs --profile extended");
  }

  void check_method() const {
    if (params_.method == Method::kMc && given("--height") && params_.tree_height != 0) {
      refuse("--method mc has no tree: its height is 0");
    }
    if (params_.method == Method::kRlfc && (given("--window") || given("--references"))) {
      refuse("--method rlfc has no motion: --window and --references do not apply");
    }
  }

  void set_quality(double quality) {
    params_.extended.quality = quality;
    const auto threshold = static_cast<uint32_t>(std::lround(75 * std::exp2((60 - quality) / 10)));
    params_.main = {threshold, threshold};
  }

  const CLI::App& app_;
  CodingOptions& options_;
  EncodeParams& params_;
};

void add_main_options(CLI::App& app, EncodeParams& params) {
  add_integer(app, "--threshold-ref", params.main.threshold_ref, 0, 1u << 20,
              "Main: minimum block energy, reference images");
  add_integer(app, "--threshold-pred", params.main.threshold_pred, 0, 1u << 20,
              "Main: minimum block energy, predictive images");
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
      "Chroma at half or full resolution (main 420)")
      ->default_str("");
}

}  // namespace

std::string_view preset_name(Preset preset) {
  switch (preset) {
    case Preset::kFast:
      return "fast";
    case Preset::kSlow:
      return "slow";
    case Preset::kMedium:
      break;
  }
  return "medium";
}

void add_coding_options(CLI::App& app, CodingOptions& options) {
  add_choice(app, "--profile", options.params.profile,
             {{"main", Profile::kMain}, {"extended", Profile::kExtended}}, "Profile of the stream")
      ->default_str("extended");
  add_decimal(app, "--quality", "Q", options.quality, 0, 100,
              "Higher is better and larger (default 60)");
  add_decimal(app, "--target-psnr", "DB", options.target_psnr, 1, 100,
              "Find the lowest quality with this PSNR over RGB");
  app.add_flag("--lossless", options.params.lossless, "Keep every RGB value; implies --chroma 444");
  add_choice(app, "--preset", options.params.extended.preset,
             {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}},
             "Extended: how long to search for the best coding")
      ->default_str("medium");
  add_structure_options(app, options);
  add_main_options(app, options.params);
}

void settle_coding_options(const CLI::App& app, CodingOptions& options) {
  Settler(app, options).run();
}

}  // namespace hmlfc::cli
