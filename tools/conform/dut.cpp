#include "conform/dut.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conform/report.hpp"
#include "conform/running_dut.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

namespace {

constexpr io::JsonLimits kDeclarationLimits{"a declaration", size_t{1} << 20, 3};

// Reads words one after the other.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : text_(text) {}

  // The next word; nothing at the end of the text or where a quote does not end.
  std::optional<std::string> next() {
    at_ = std::min(text_.find_first_not_of(" \t\n", at_), text_.size());
    if (at_ == text_.size()) return std::nullopt;
    std::string word;
    char quote = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == quote && quote != 0) {
        quote = 0;
      } else if (quote == 0 && (c == '"' || c == '\'')) {
        quote = c;
      } else if (c == '\\' && quote != '\'' && at_ + 1 < text_.size()) {
        word += text_[++at_];
      } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
        break;
      } else {
        word += c;
      }
    }
    unfinished_ = quote != 0;
    if (unfinished_) return std::nullopt;
    return word;
  }

  bool unfinished() const { return unfinished_; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  bool unfinished_ = false;
};

// Thrown by the readers of keys; becomes the error of read_dut().
struct WrongValue {
  std::string what;
};

template <class T>
T value_of(const Json& json, const std::string& key) {
  try {
    if constexpr (std::is_same_v<T, std::vector<unsigned>>) {
      return io::integers_at<unsigned>(json, key);
    } else {
      return json.at(key).get<T>();
    }
  } catch (const Json::exception&) {
    throw WrongValue{fmt::format("\"{}\" is missing or has a value of the wrong kind", key)};
  }
}

template <class T>
void read_if_there(const Json& json, const std::string& key, T& target) {
  if (json.contains(key)) target = value_of<T>(json, key);
}

// An integer in [lo, hi].
template <class T>
void read_number(const Json& json, const std::string& key, T& target, int64_t lo, int64_t hi) {
  if (!json.contains(key)) return;
  try {
    const auto value = io::integer_at<int64_t>(json, key);
    if (value >= lo && value <= hi) return static_cast<void>(target = static_cast<T>(value));
  } catch (const Json::exception&) {
  }
  throw WrongValue{fmt::format("\"{}\" is not an integer in [{}, {}]", key, lo, hi)};
}

void allow_keys(const Json& json, const std::string& where, const std::set<std::string>& keys) {
  if (!json.is_object()) throw WrongValue{where + " is not an object"};
  for (const auto& item : json.items()) {
    if (!keys.contains(item.key())) {
      throw WrongValue{fmt::format("{} has the unknown key {}", where, io::shown_json(item.key()))};
    }
  }
}

void read_limits(const Json& json, Claims& claims) {
  std::set<std::string> keys{"block_log2"};
  for (const ClaimedLimit& limit : kClaimedLimits) keys.insert(limit.name);
  allow_keys(json, "\"limits\"", keys);
  for (const ClaimedLimit& limit : kClaimedLimits) {
    read_number(json, limit.name, claims.*limit.value, limit.least, limit.greatest);
  }
  read_if_there(json, "block_log2", claims.block_log2);
}

Profile read_profile(const Json& json) {
  const auto name = value_of<std::string>(json, "profile");
  for (const Profile profile : {Profile::kMain, Profile::kExtended}) {
    if (profile_name(profile) == name) return profile;
  }
  throw WrongValue{"\"profile\" is " + io::shown_json(name) + ", neither main nor extended"};
}

std::vector<Waiver> read_waivers(const Json& json) {
  std::vector<Waiver> waivers;
  for (const Json& entry : value_of<std::vector<Json>>(json, "waivers")) {
    allow_keys(entry, "a waiver", {"vector", "reason"});
    Waiver waiver{value_of<std::string>(entry, "vector"), value_of<std::string>(entry, "reason")};
    if (waiver.reason.empty()) {
      throw WrongValue{"the waiver of " + io::shown_json(waiver.vector) + " has no reason"};
    }
    waivers.push_back(std::move(waiver));
  }
  return waivers;
}

std::vector<std::string> words_of(std::string_view text, const Places& places,
                                  std::span<const char* const> needed) {
  WordReader reader(text);
  std::vector<std::string> words;
  while (auto word = reader.next()) words.push_back(std::move(*word));
  if (reader.unfinished()) {
    throw WrongValue{io::shown_json(text) + ": unterminated quote in this command line"};
  }
  if (words.empty()) throw WrongValue{"the command line is empty"};
  for (const char* place : needed) {
    if (text.find(place) == std::string_view::npos) {
      throw WrongValue{fmt::format("the command {} does not have {}", io::shown_json(text), place)};
    }
  }
  return fill_in(words, places);
}

constexpr std::string_view kLines = "lines:";
constexpr const char* kCommandPlaces[] = {"{input}", "{output}"};
constexpr const char* kTracePlaces[] = {"{input}", "{view_row}", "{view_col}",
                                        "{plane}", "{block_x}",  "{block_y}"};

// A program that speaks the line protocol.
void set_lines(Dut& dut, std::vector<std::string> command) {
  dut.command = std::move(command);
  dut.waiting = std::make_shared<WaitingDuts>();
  dut.error_names = true;
}

// This program's command serve runs libraries, so that a crash ends another process.
void set_library(Dut& dut, const std::string& library, const Places& places) {
  set_lines(dut, {places.at("hmlfc"), "serve", library});
}

void read_program(Dut& dut, const Json& json, const Places& places) {
  const auto count = json.contains("command") + json.contains("lines") + json.contains("library");
  if (count != 1) {
    throw WrongValue{"exactly one of \"command\", \"lines\" and \"library\" is needed"};
  }
  read_if_there(json, "by_block", dut.by_block);
  if (json.contains("library")) {
    return set_library(dut, fill_in({value_of<std::string>(json, "library")}, places).front(),
                       places);
  }
  if (json.contains("lines")) {
    return set_lines(dut, words_of(value_of<std::string>(json, "lines"), places, {}));
  }
  dut.command = words_of(value_of<std::string>(json, "command"), places, kCommandPlaces);
  if (json.contains("trace")) {
    dut.trace = words_of(value_of<std::string>(json, "trace"), places, kTracePlaces);
  }
  read_if_there(json, "error_names", dut.error_names);
}

Dut read_declaration(const std::filesystem::path& file, Places places) {
  const auto mapped = io::map_file(file);
  if (!mapped) throw WrongValue{"cannot be read"};
  const auto read = io::parse_json<Json>(mapped->bytes(), kDeclarationLimits);
  if (!read) throw WrongValue{"is not JSON: " + read.error()};
  const Json& json = *read;
  allow_keys(json, "the declaration",
             {"name", "command", "lines", "library", "by_block", "trace", "profile", "level",
              "limits", "error_names", "checks_sections", "waivers", "comment"});
  places["dut"] = std::filesystem::absolute(file).parent_path().string();
  Dut dut;
  dut.name = value_of<std::string>(json, "name");
  read_program(dut, json, places);
  if (json.contains("profile")) dut.claims.profile = read_profile(json);
  read_number(json, "level", dut.claims.level, 0, 3);
  read_if_there(json, "checks_sections", dut.checks_sections);
  if (json.contains("limits")) read_limits(json.at("limits"), dut.claims);
  if (json.contains("waivers")) dut.waivers = read_waivers(json);
  return dut;
}

}  // namespace

std::vector<std::string> fill_in(const std::vector<std::string>& words, const Places& places) {
  std::vector<std::string> filled;
  for (const std::string& word : words) {
    std::string text;
    for (size_t at = 0; at < word.size();) {
      const size_t end = word[at] == '{' ? word.find('}', at) : std::string::npos;
      const auto place = end == std::string::npos
                             ? places.end()
                             : places.find(std::string_view(word).substr(at + 1, end - at - 1));
      if (place != places.end()) {
        text += place->second;
        at = end + 1;
      } else {
        text += word[at++];
      }
    }
    filled.push_back(std::move(text));
  }
  return filled;
}

const Waiver* Dut::waiver(const std::string& id) const {
  const auto found = std::ranges::find(waivers, id, &Waiver::vector);
  return found == waivers.end() ? nullptr : &*found;
}

io::IoResult<Dut> read_dut(const std::string& text, const std::filesystem::path& hmlfc) {
  const Places names{{"hmlfc", hmlfc.string()}, {"bin", hmlfc.parent_path().string()}};
  const std::filesystem::path path(text);
  try {
    Dut dut;
    if (path.extension() == ".json") {
      dut = read_declaration(path, names);
      dut.text = text;
      return dut;
    }
    dut.name = dut.text = text;
    if (path.extension() == ".so") {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(path, ignored)) throw WrongValue{"no such library"};
      set_library(dut, std::filesystem::absolute(path).string(), names);
    } else if (text.starts_with(kLines)) {
      set_lines(dut, words_of(std::string_view(text).substr(kLines.size()), names, {}));
    } else {
      dut.command = words_of(text, names, kCommandPlaces);
    }
    return dut;
  } catch (const WrongValue& error) {
    return io::file_error(text, error.what);
  }
}

}  // namespace hmlfc::conform
