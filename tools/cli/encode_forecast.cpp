#include "cli/encode_forecast.hpp"

#include <cmath>

#include <fmt/format.h>

#include "cli/output.hpp"

namespace hmlfc::cli {
namespace {

constexpr double kSoon = 10;  // seconds

// "40 seconds", "3 minutes" or "1.5 hours".
std::string about(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} seconds", std::ceil(seconds / 5) * 5);
  if (seconds < 5400) return fmt::format("{:.0f} minutes", std::ceil(seconds / 60));
  return fmt::format("{:.1f} hours", seconds / 3600);
}

}  // namespace

void note_forecast(const EncodeForecast& forecast) {
  if (forecast.seconds < kSoon) return;
  note(fmt::format("Encoding will take about {} and {:.2g} MB", about(forecast.seconds),
                   forecast.bytes / 1e6));
}

void note_forecast(size_t done, size_t all, double seconds, const char* what) {
  const double of_all = static_cast<double>(all) * seconds / static_cast<double>(done);
  if (all < 2 || done != (all + 7) / 8 || of_all < kSoon) return;
  note(fmt::format("Encoding {} {} will take about {}", all, what, about(of_all)));
}

}  // namespace hmlfc::cli
