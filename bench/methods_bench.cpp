// The table of docs/results/methods.md: HMLFC, RLFC and MC on real light fields at one PSNR.
//
// Usage: ./run bench methods [PSNR] [FOLDER...]
// PSNR: target over RGB in dB, default 40. FOLDER: folders of views; default: the light fields of
// HMLFC_DATA_DIR (../shared/data where it is not set). CPU times are those of the whole process
// over all threads.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "io/light_field_files.hpp"

namespace {

using namespace hmlfc;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<std::filesystem::path> default_folders() {
  const char* data = std::getenv("HMLFC_DATA_DIR");
  const std::filesystem::path base = data != nullptr ? data : HMLFC_DEFAULT_DATA_DIR;
  return {base / "stanford-chess-16x16-700x400", base / "hci-antinous-9x9-512x512",
          base / "stanford-legoknights-17x17-256x256-jpeg"};
}

const char* name_of(Method method) {
  return method == Method::kHmlfc ? "hmlfc" : method == Method::kRlfc ? "rlfc" : "mc";
}

// The smaller of the two streams, with halved and with full chroma, that reach the target.
std::optional<EncodeParams> best_params(const LightField& field, Method method, double target_db) {
  const LightFieldShape& shape = field.shape();
  const uint64_t samples = uint64_t{shape.rows} * shape.cols * shape.width * shape.height * 3;
  std::optional<EncodeParams> best;
  size_t best_size = 0;
  for (const ChromaFormat chroma : {ChromaFormat::k420, ChromaFormat::k444}) {
    EncodeParams params;
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

// One row: the parameters for the target, then one encoding and one decoding by the clock.
bool print_row(const std::string& name, const LightField& field, Method method, double target_db) {
  const auto found = best_params(field, method, target_db);
  if (!found) {
    fmt::print(stderr, "{} {}: {} dB is out of reach\n", name, name_of(method), target_db);
    return false;
  }
  const double start = cpu_seconds();
  const auto encoded = encode(field, *found);
  const double encoded_at = cpu_seconds();
  const auto decoder = Decoder::open(encoded->bytes);
  if (!decoder || !decoder->decode_all([](ViewPos, RgbImage&&) {})) return false;
  const double decoded_at = cpu_seconds();

  const LightFieldShape& shape = field.shape();
  const uint64_t views = uint64_t{shape.rows} * shape.cols;
  const uint64_t pixels = views * shape.width * shape.height;
  const double bpp = 8.0 * static_cast<double>(encoded->bytes.size()) / static_cast<double>(pixels);
  fmt::print(
      "| {} | {} | {} | {} | {:.3f} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.0f} |\n",
      name, name_of(method), found->chroma == ChromaFormat::k420 ? "4:2:0" : "4:4:4",
      found->threshold_pred, bpp, 3 * shape.depth / bpp,
      psnr(encoded->error.rgb_squares, pixels * 3, shape.depth),
      psnr(encoded->error.y_squares, pixels, shape.depth), encoded_at - start,
      decoded_at - encoded_at, static_cast<double>(decoder->reference_bytes()) / 1024);
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const double target_db = argc > 1 ? std::atof(argv[1]) : 40;
  std::vector<std::filesystem::path> folders(argv + std::min(argc, 2), argv + argc);
  if (folders.empty()) folders = default_folders();
  fmt::print(
      "| light field | method | chroma | threshold | bpp | ratio | PSNR RGB | PSNR Y | encode CPU "
      "s | "
      "decode CPU s "
      "| references KiB |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  int failures = 0;
  for (const auto& folder : folders) {
    const auto views = io::list_views(folder);
    if (!views) {
      fmt::print(stderr, "skipped: {}\n", views.error().message);
      ++failures;
      continue;
    }
    const auto field = io::load_light_field(*views, 0);
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
