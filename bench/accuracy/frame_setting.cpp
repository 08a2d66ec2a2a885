#include "accuracy/frame_setting.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace hmlfc::bench {
namespace {

constexpr std::array kFilters = {Filter::kNearest, Filter::kBilinear, Filter::kQuadrilinear};
constexpr std::array<std::string_view, 3> kBackends = {"cpu", "golden", "gpu"};  // as in Backend

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (size_t colon = text.find(':'); colon != text.npos; colon = text.find(':')) {
    parts.push_back(text.substr(0, colon));
    text.remove_prefix(colon + 1);
  }
  parts.push_back(text);
  return parts;
}

template <class Integer>
bool read(std::string_view text, Integer min, Integer max, Integer& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
}

}  // namespace

std::optional<FrameSetting> parse_frame_setting(std::string_view text) {
  const auto parts = split(text);
  if (parts.size() != 4) return std::nullopt;
  FrameSetting setting;
  setting.text = text;
  const auto filter = std::ranges::find(kFilters, parts[0], filter_name);
  const auto backend = std::ranges::find(kBackends, parts[3]);
  const bool numbers = read(parts[1], 1, 16, setting.levels) &&
                       read(parts[2], size_t{0}, size_t{1} << 20, setting.cache_mib);
  if (filter == kFilters.end() || backend == kBackends.end() || !numbers) return std::nullopt;
  setting.filter = *filter;
  setting.backend = static_cast<Backend>(backend - kBackends.begin());
  return setting;
}

}  // namespace hmlfc::bench
