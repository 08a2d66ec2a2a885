// The table of the README: HMLFC, RLFC and MC on real light fields at one PSNR.
//
// Usage: ./run bench methods [PSNR] [FOLDER...]
// PSNR: target over RGB in dB, default 40. FOLDER: folders of views; default: three light fields of
// HMLFC_DATA_DIR, or of ../shared/data if that is not set. CPU times are those of all threads.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "common/data_folder.hpp"
#include "io/light_field_files.hpp"
#include "render/timing.hpp"

namespace {

using namespace hmlfc;

const char* name_of(Method method) {
  return method == Method::kHmlfc ? "hmlfc" : method == Method::kRlfc ? "rlfc" : "mc";
}

// The parameters, with halved or full chroma, of the smallest stream that reaches the target.
std::optional<EncodeParams> best_params(const LightField& field, Method method, double target_db) {
  const LightFieldShape& shape = field.shape();
  const uint64_t samples = uint64_t{shape.rows} * shape.cols * shape.width * shape.height * 3;
  std::optional<EncodeParams> best;
  size_t best_size = 0;
  for (const ChromaFormat chroma : {ChromaFormat::k420, ChromaFormat::k444}) {
    EncodeParams params;
    params.profile = Profile::kMain;
    params.method = method;
    params.chroma = chroma;
    const auto found = encode_to_psnr(field, params, target_db);
    if (!found || psnr(found->error.rgb_squares, samples, shape.depth) < target_db) continue;
    if (best && found->bytes.size() >= best_size) continue;
    best = found->params;
    best_size = found->bytes.size();
  }
  return best;
}

// Prints a row: finds the parameters for the target, then times one encoding and one decoding.
bool print_row(const std::string& name, const LightField& field, Method method, double target_db) {
  const auto found = best_params(field, method, target_db);
  if (!found) {
    fmt::print(stderr, "{} {}: {} dB is out of reach\n", name, name_of(method), target_db);
    return false;
  }
  const bench::Clock clock;
  const auto encoded = encode(field, *found);
  const double encoded_at = clock.cpu_seconds();
  const auto decoder = Decoder::open(encoded->bytes);
  if (!decoder || !decoder->decode_all([](ViewPos, RgbImage&&) {})) return false;
  const double decoded_at = clock.cpu_seconds();

  const LightFieldShape& shape = field.shape();
  const uint64_t views = uint64_t{shape.rows} * shape.cols;
  const uint64_t pixels = views * shape.width * shape.height;
  const double bpp = 8.0 * static_cast<double>(encoded->bytes.size()) / static_cast<double>(pixels);
  fmt::print(
      "| {} | {} | {} | {} | {:.3f} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.0f} |\n",
      name, name_of(method), found->chroma == ChromaFormat::k420 ? "4:2:0" : "4:4:4",
      found->main.threshold_pred, bpp, 3 * shape.depth / bpp,
      psnr(encoded->error.rgb_squares, pixels * 3, shape.depth),
      psnr(encoded->error.y_squares, pixels, shape.depth), encoded_at, decoded_at - encoded_at,
      static_cast<double>(decoder->reference_bytes()) / 1024);
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const double target_db = argc > 1 ? std::atof(argv[1]) : 40;
  std::vector<std::filesystem::path> folders(argv + std::min(argc, 2), argv + argc);
  if (folders.empty()) {
    folders = {data_folder("stanford-chess-16x16-700x400"), data_folder("hci-antinous-9x9-512x512"),
               data_folder("stanford-legoknights-17x17-256x256-jpeg")};
  }
  fmt::print(
      "| light field | method | chroma | threshold | bpp | ratio | PSNR RGB | PSNR Y "
      "| encode CPU s | decode CPU s | references KiB "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  int failures = 0;
  for (const auto& folder : folders) {
    const auto views = io::list_views(folder);
    const auto field = views ? io::load_light_field(*views, 0) : tl::unexpected(views.error());
    if (!field) {
      fmt::print(stderr, "skipped: {}\n", field.error().message);
      ++failures;
      continue;
    }
    for (const Method method : {Method::kHmlfc, Method::kRlfc, Method::kMc}) {
      if (!print_row(folder.filename().string(), *field, method, target_db)) ++failures;
    }
  }
  return failures == 0 ? 0 : 1;
}
