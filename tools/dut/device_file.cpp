#include "dut/device_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

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

std::vector<unsigned> block_sizes(const Words& words) {
  std::vector<unsigned> logs;
  for (const std::string& word : words) {
    const auto size = static_cast<unsigned>(number(word, 2, 8));
    if (!std::has_single_bit(size)) throw WrongLine{"block sizes are 2, 4 and 8"};
    logs.push_back(static_cast<unsigned>(std::countr_zero(size)));
  }
  if (logs.empty()) throw WrongLine{"name at least one of 2, 4 and 8"};
  return logs;
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

Reader flag(bool Device::*field, std::string yes = "yes", std::string no = "no") {
  return [=](Device& device, const Words& words) { device.*field = choice(words, yes, no); };
}

std::map<std::string, Reader> make_readers() {
  std::map<std::string, Reader> readers{
      {"name", [](Device& d, const Words& words) { d.name = one_word(words); }},
      {"profile",
       [](Device& d, const Words& words) {
         d.claims.profile = choice(words, "main", "extended") ? Profile::kMain : Profile::kExtended;
       }},
      {"level",
       [](Device& d, const Words& w) {
         d.claims.level = static_cast<int>(number(one_word(w), 0, 3));
       }},
      {"block_sizes",
       [](Device& d, const Words& words) { d.claims.block_log2 = block_sizes(words); }},
      {"rgb", flag(&Device::rgb)},
      {"stop_levels", flag(&Device::stop_levels)},
      {"stages", [](Device& d, const Words& words) { d.stages = stages(words); }},
      {"stage_records", flag(&Device::every_stage, "every", "some")},
      {"held_chroma", flag(&Device::held_chroma)},
      {"answers", flag(&Device::tagged, "tagged", "in_order")},
      {"bus_errors", flag(&Device::bus_errors)},
      {"section_checks", flag(&Device::section_checks)},
  };
  for (const ClaimedLimit& limit : kClaimedLimits) {
    readers["max_" + std::string(limit.name)] = [&limit](Device& d, const Words& words) {
      d.claims.*limit.value = number(one_word(words), limit.least, limit.greatest);
    };
  }
  return readers;
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> kReaders = make_readers();
  return kReaders;
}

std::string known_names() {
  std::string names;
  for (const auto& [name, reader] : readers()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

// The line of each name.
using Lines = std::map<std::string, int>;

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
  return device;
}

}  // namespace hmlfc::lockstep
