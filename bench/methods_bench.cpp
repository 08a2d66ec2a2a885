// The table of docs/results/methods.md: HMLFC, RLFC and MC on real light fields at one PSNR.
//
// Usage: ./run bench methods [PSNR] [FOLDER...]
// PSNR: target over RGB in dB, default 40. FOLDER: folders of views; default: three light fields of
// HMLFC_DATA_DIR, or of ../shared/data if that is not set. CPU times are those of all threads.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "common/program.hpp"
#include "io/data_folder.hpp"
#include "io/light_field_files.hpp"
#include "terminal/clock.hpp"

namespace {

using namespace hmlfc;

std::vector<std::filesystem::path> default_folders() {
  return {data_folder("stanford-chess-16x16-700x400"), data_folder("hci-antinous-9x9-512x512"),
          data_folder("stanford-legoknights-17x17-256x256-jpeg")};
}

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
    const auto found = encode_to(field, params, TargetPsnr{target_db});
    if (!found || psnr(found->error.rgb_squares, samples, shape.depth) < target_db) continue;
    if (best && found->bytes.size() >= best_size) continue;
    best = found->params;
    best_size = found->bytes.size();
  }
  return best;
}

// Prints a row: finds the parameters for the target, then times one encoding and one decoding.
void print_row(const std::string& name, const LightField& field, Method method, double target_db) {
  const auto found = best_params(field, method, target_db);
  if (!found) throw std::runtime_error(fmt::format("{} dB is out of reach", target_db));
  const Clock encoding;
  const auto encoded = bench::value_of(encode(field, *found));
  const double encode_seconds = encoding.cpu_seconds();
  const Clock decoding;
  const Decoder decoder = bench::value_of(Decoder::open(encoded.bytes));
  bench::value_of(decoder.decode_all([](ViewPos, RgbImage&&) {}));
  const double decode_seconds = decoding.cpu_seconds();

  const LightFieldShape& shape = field.shape();
  const uint64_t views = uint64_t{shape.rows} * shape.cols;
  const uint64_t pixels = views * shape.width * shape.height;
  const double bpp = 8.0 * static_cast<double>(encoded.bytes.size()) / static_cast<double>(pixels);
  fmt::print(
      "| {} | {} | {} | {} | {:.3f} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.0f} |\n",
      name, name_of(method), found->chroma == ChromaFormat::k420 ? "4:2:0" : "4:4:4",
      found->main.threshold_pred, bpp, 3 * shape.depth / bpp,
      psnr(encoded.error.rgb_squares, pixels * 3, shape.depth),
      psnr(encoded.error.y_squares, pixels, shape.depth), encode_seconds, decode_seconds,
      static_cast<double>(decoder.reference_bytes()) / 1024);
  std::fflush(stdout);
}

int print_rows(const std::string& name, const LightField& field, double target_db) {
  int status = 0;
  for (const Method method : {Method::kHmlfc, Method::kRlfc, Method::kMc}) {
    const int failed = bench::run_program(name_of(method), [&] {
      print_row(name, field, method, target_db);
      return 0;
    });
    status = std::max(status, failed);
  }
  return status;
}

int run(const std::vector<std::string>& arguments) {
  const double target_db = arguments.empty() ? 40 : std::stod(arguments[0]);
  std::vector<std::filesystem::path> folders(
      arguments.begin() + static_cast<ptrdiff_t>(std::min<size_t>(arguments.size(), 1)),
      arguments.end());
  if (folders.empty()) folders = default_folders();
  fmt::print(
      "| light field | method | chroma | threshold | bpp | ratio | PSNR RGB | PSNR Y "
      "| encode CPU s | decode CPU s | references KiB "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  int status = 0;
  for (const auto& folder : folders) {
    const int failed = bench::run_program(folder.c_str(), [&] {
      const auto views = bench::value_of(io::list_views(folder));
      return print_rows(folder.filename().string(), bench::value_of(io::load_light_field(views, 0)),
                        target_db);
    });
    status = std::max(status, failed);
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_methods", [&] { return run({argv + 1, argv + argc}); });
}
