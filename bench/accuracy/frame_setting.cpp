#include "accuracy/frame_setting.hpp"

#include <array>
#include <charconv>
#include <vector>

namespace hmlfc::bench {
namespace {

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

constexpr std::array kBackends = {Named<Backend>{"cpu", Backend::kCpu},
                                  Named<Backend>{"golden", Backend::kGolden},
                                  Named<Backend>{"gpu", Backend::kGpu}};
constexpr std::array kFilters = {Filter::kNearest, Filter::kBilinear, Filter::kQuadrilinear};

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
bool read(std::string_view text, Integer least, Integer most, Integer& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= least &&
         value <= most;
}

}  // namespace

std::optional<FrameSetting> parse_frame_setting(std::string_view text) {
  const auto parts = split(text);
  if (parts.size() != 4) return std::nullopt;
  FrameSetting setting;
  setting.text = text;
  bool known_filter = false;
  for (const Filter filter : kFilters) {
    if (filter_name(filter) != parts[0]) continue;
    setting.filter = filter;
    known_filter = true;
  }
  bool known_backend = false;
  for (const auto& [name, backend] : kBackends) {
    if (name != parts[3]) continue;
    setting.backend = backend;
    known_backend = true;
  }
  const bool numbers = read(parts[1], 1, 16, setting.levels) &&
                       read(parts[2], size_t{0}, size_t{1} << 20, setting.cache_mib);
  if (!known_filter || !known_backend || !numbers) return std::nullopt;
  return setting;
}

}  // namespace hmlfc::bench
