#include "dut/device_file.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <hmlfc/stream_info.hpp>

namespace hmlfc::lockstep {
namespace {

using Words = std::vector<std::string>;

// What is wrong with a line, and what to do; becomes the error of parse_device().
struct WrongLine {
  std::string what;
};

int64_t number(const std::string& word, int64_t least, int64_t greatest) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value < least ||
      value > greatest) {
    throw WrongLine{"\"" + word + "\" is no number from " + std::to_string(least) + " to " +
                    std::to_string(greatest)};
  }
  return value;
}

const std::string& one_word(const Words& words) {
  if (words.size() != 1) throw WrongLine{"this name takes one value"};
  return words.front();
}

// Whether the value is `yes`; it must be one of the two.
bool choice(const Words& words, const std::string& yes, const std::string& no) {
  const std::string& word = one_word(words);
  if (word != yes && word != no) {
    throw WrongLine{"\"" + word + "\" is neither " + yes + " nor " + no};
  }
  return word == yes;
}

std::set<int64_t> block_sizes(const Words& words) {
  std::set<int64_t> sizes;
  for (const std::string& word : words) {
    const int64_t size = number(word, 2, 8);
    if (size != 2 && size != 4 && size != 8) throw WrongLine{"block sizes are 2, 4 and 8"};
    sizes.insert(size);
  }
  if (sizes.empty()) throw WrongLine{"name at least one of 2, 4 and 8"};
  return sizes;
}

std::array<bool, 4> stages(const Words& words) {
  std::array<bool, 4> shown{};
  if (words == Words{"none"}) return shown;
  for (const std::string& word : words) {
    const auto found = std::ranges::find(kStageNames, word);
    if (found == kStageNames.end()) {
      throw WrongLine{"\"" + word +
                      "\" is no stage; name none alone, or some of residual, reference, "
                      "prediction and sample"};
    }
    shown[static_cast<size_t>(found - kStageNames.begin())] = true;
  }
  if (words.empty()) throw WrongLine{"name none, or the stages"};
  return shown;
}

using Reader = std::function<void(Device&, const Words&)>;

Reader limit(int64_t Device::*field, int64_t least, int64_t greatest) {
  return [=](Device& device, const Words& words) {
    device.*field = number(one_word(words), least, greatest);
  };
}

Reader flag(bool Device::*field, std::string yes = "yes", std::string no = "no") {
  return [=](Device& device, const Words& words) { device.*field = choice(words, yes, no); };
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> kReaders{
      {"name", [](Device& d, const Words& words) { d.name = one_word(words); }},
      {"profile",
       [](Device& d, const Words& words) {
         d.profile = choice(words, "main", "extended") ? Profile::kMain : Profile::kExtended;
       }},
      {"level",
       [](Device& d, const Words& w) { d.level = static_cast<int>(number(one_word(w), 0, 3)); }},
      {"block_sizes", [](Device& d, const Words& words) { d.block_sizes = block_sizes(words); }},
      {"max_rows", limit(&Device::max_rows, 1, 4096)},
      {"max_cols", limit(&Device::max_cols, 1, 4096)},
      {"max_width", limit(&Device::max_width, 1, 65536)},
      {"max_height", limit(&Device::max_height, 1, 65536)},
      {"max_depth", limit(&Device::max_depth, 8, 12)},
      {"max_tree_height", limit(&Device::max_tree_height, 0, 15)},
      {"rgb", flag(&Device::rgb)},
      {"stop_levels", flag(&Device::stop_levels)},
      {"stages", [](Device& d, const Words& words) { d.stages = stages(words); }},
      {"stage_records", flag(&Device::every_stage, "every", "some")},
      {"held_chroma", flag(&Device::held_chroma)},
      {"answers", flag(&Device::tagged, "tagged", "in_order")},
      {"bus_errors", flag(&Device::bus_errors)},
      {"section_checks", flag(&Device::section_checks)},
  };
  return kReaders;
}

std::string known_names() {
  std::string names;
  for (const auto& [name, reader] : readers()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

// The line of each name.
using Lines = std::map<std::string, int>;

// A line that says what another rules out.
struct Contradiction {
  int line;
  std::string what;
};

std::vector<Contradiction> contradictions(const Device& device, const Lines& lines) {
  std::vector<Contradiction> found;
  const auto check = [&](const char* name, bool wrong, const std::string& what) {
    const auto line = lines.find(name);
    if (line != lines.end() && wrong) found.push_back({line->second, what});
  };
  const std::string no_stages = "there are no stages: leave this line out, or name them in stages";
  check("stage_records", !device.shows_stages(), no_stages);
  check("held_chroma", device.held_chroma && !device.shows_stages(), no_stages);
  check("held_chroma", device.held_chroma && !device.rgb,
        "chroma is held for RGB alone: rgb is no");
  check("held_chroma", device.held_chroma && !device.every_stage,
        "stage_records some already allows for it: leave this line out");
  if (!lines.contains("level")) return found;
  const ConformanceLimits& most = kConformanceLimits[static_cast<size_t>(device.level)];
  const std::pair<const char*, std::pair<int64_t, int64_t>> limits[] = {
      {"max_rows", {device.max_rows, most.grid_side}},
      {"max_cols", {device.max_cols, most.grid_side}},
      {"max_width", {device.max_width, most.view_side}},
      {"max_height", {device.max_height, most.view_side}},
      {"max_depth", {device.max_depth, most.depth}},
      {"max_tree_height", {device.max_tree_height, most.tree_height}}};
  for (const auto& [name, values] : limits) {
    check(name, values.first > values.second,
          "level " + std::to_string(device.level) + " ends at " + std::to_string(values.second) +
              " (LVL-1): lower this limit, or raise level");
  }
  return found;
}

std::string at(const std::string& file, int line, const std::string& what) {
  return file + ":" + std::to_string(line) + ": " + what + "\n";
}

}  // namespace

bool Device::shows_stages() const {
  return std::ranges::any_of(stages, [](bool shown) { return shown; });
}

tl::expected<Device, std::string> parse_device(const std::string& text, const std::string& file) {
  Device device;
  Lines lines;
  std::istringstream in(text);
  std::string line;
  for (int count = 1; std::getline(in, line); ++count) {
    std::istringstream words_in(line.substr(0, line.find('#')));
    std::string name;
    if (!(words_in >> name)) continue;
    Words words;
    for (std::string word; words_in >> word;) words.push_back(word);
    const auto reader = readers().find(name);
    if (reader == readers().end()) {
      return tl::unexpected(
          at(file, count, "unknown name \"" + name + "\"; the names are " + known_names()));
    }
    if (const auto [before, first] = lines.emplace(name, count); !first) {
      return tl::unexpected(at(file, count,
                               name + " stands in line " + std::to_string(before->second) +
                                   " too: leave one of them out"));
    }
    try {
      reader->second(device, words);
    } catch (const WrongLine& wrong) {
      return tl::unexpected(at(file, count, name + ": " + wrong.what));
    }
  }
  if (!lines.contains("profile")) {
    return tl::unexpected(at(file, 1,
                             "profile is missing: add \"profile main\" or \"profile "
                             "extended\""));
  }
  for (const Contradiction& found : contradictions(device, lines)) {
    return tl::unexpected(at(file, found.line, found.what));
  }
  return device;
}

std::string beyond(const Device& device, const StreamHeader& header) {
  if (header.profile == Profile::kExtended && device.profile == Profile::kMain) {
    return "the stream's profile is extended, the device's main";
  }
  if (!device.block_sizes.contains(header.block_size())) {
    return "the device has no blocks of " + std::to_string(header.block_size());
  }
  if (const int level = conformance_level(header); level > device.level) {
    return "the stream's level is " + std::to_string(level) + ", the device's " +
           std::to_string(device.level);
  }
  const std::tuple<const char*, int64_t, int64_t> limits[] = {
      {"rows", header.rows, device.max_rows},
      {"cols", header.cols, device.max_cols},
      {"width", header.width, device.max_width},
      {"height", header.height, device.max_height},
      {"depth", header.depth, device.max_depth},
      {"tree_height", header.tree_height, device.max_tree_height}};
  for (const auto& [name, value, most] : limits) {
    if (value > most) {
      return std::string(name) + " is " + std::to_string(value) + ", the device's greatest " +
             std::to_string(most);
    }
  }
  return {};
}

}  // namespace hmlfc::lockstep
