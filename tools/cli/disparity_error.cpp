#include "cli/disparity_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/view_source.hpp"
#include "io/disparity_files.hpp"

namespace hmlfc::cli {
namespace {

// Errors above which a pixel is bad, as the HCI 4D Light Field Benchmark counts them.
constexpr std::array kBadPix{0.07, 0.03, 0.01};

// Over the pixels of which both maps have a finite number.
struct DisparityError {
  uint32_t width = 0;    // of the maps
  uint32_t height = 0;   // of the maps
  uint64_t pixels = 0;   // compared, at least 1
  uint64_t unknown = 0;  // not finite in one of them
  double mean_abs = 0;   // pixels a column
  double mean_square = 0;
  double largest = 0;
  std::array<uint64_t, kBadPix.size()> bad{};  // pixels above each of kBadPix
  double mean_abs_opposite = 0;                // mean_abs with the other sign of one map
};

DisparityError error_of(const io::FloatMap& a, const io::FloatMap& b, const Rect& rect) {
  DisparityError error{.width = a.width, .height = a.height};
  for (uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (uint32_t x = rect.x; x < rect.x + rect.width; ++x) {
      const double in_a = a.pixels[size_t{y} * a.width + x];
      const double in_b = b.pixels[size_t{y} * a.width + x];
      const double off = std::abs(in_a - in_b);
      if (!std::isfinite(off)) {
        ++error.unknown;
        continue;
      }
      ++error.pixels;
      error.mean_abs += off;
      error.mean_abs_opposite += std::abs(in_a + in_b);
      error.mean_square += off * off;
      error.largest = std::max(error.largest, off);
      for (size_t k = 0; k < kBadPix.size(); ++k) error.bad[k] += off > kBadPix[k] ? 1u : 0u;
    }
  }
  const auto pixels = static_cast<double>(error.pixels);
  error.mean_abs /= pixels;
  error.mean_abs_opposite /= pixels;
  error.mean_square /= pixels;
  return error;
}

double percent(uint64_t part, uint64_t whole) {
  return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_error(const DisparityError& error) {
  std::string text =
      fmt::format("Disparity maps    {} x {} pixels, {} compared, {} unknown\n", error.width,
                  error.height, grouped(error.pixels), grouped(error.unknown));
  if (error.largest == 0) return print(text + "Identical\n");
  text += fmt::format(
      "Mean error        {:.4f} pixels a column\nLargest error     {:.4f}\n"
      "MSE x 100         {:.4f}\n",
      error.mean_abs, error.largest, 100 * error.mean_square);
  for (size_t k = 0; k < kBadPix.size(); ++k) {
    text += fmt::format("BadPix {:.2f}       {:.2f} %\n", kBadPix[k],
                        percent(error.bad[k], error.pixels));
  }
  print(text);
}

void print_error_json(const DisparityError& error) {
  Json json{{"mean_abs_error", error.mean_abs},
            {"max_abs_error", error.largest},
            {"mse_x100", 100 * error.mean_square}};
  for (size_t k = 0; k < kBadPix.size(); ++k) {
    json["badpix"][fmt::format("{:.2f}", kBadPix[k])] = percent(error.bad[k], error.pixels);
  }
  json["pixels"] = error.pixels;
  json["unknown"] = error.unknown;
  json["identical"] = error.largest == 0;
  print_json(json);
}

}  // namespace

ExitCode compare_maps(const std::filesystem::path& a, const std::filesystem::path& b,
                      const std::optional<Rect>& rect, bool json) {
  const auto in_a = value_or_throw(io::read_pfm(a), ExitCode::kInput);
  const auto in_b = value_or_throw(io::read_pfm(b), ExitCode::kInput);
  if (in_a.width != in_b.width || in_a.height != in_b.height) {
    throw Failure(ExitCode::kInput,
                  fmt::format("The maps differ in size: {} x {} versus {} x {} pixels", in_a.width,
                              in_a.height, in_b.width, in_b.height));
  }
  const Rect all{0, 0, in_a.width, in_a.height};
  if (rect) check_rect(*rect, {1, 1, in_a.width, in_a.height, 8});
  const DisparityError error = error_of(in_a, in_b, rect.value_or(all));
  if (error.pixels == 0) {
    throw Failure(ExitCode::kInput, "There is no pixel of which both maps have a number");
  }
  if (2 * error.mean_abs_opposite < error.mean_abs) {
    note("The maps have opposite signs: hmlfc disparity --positive chooses one");
  }
  json ? print_error_json(error) : print_error(error);
  return error.largest == 0 ? ExitCode::kDone : ExitCode::kDifferent;
}

}  // namespace hmlfc::cli
