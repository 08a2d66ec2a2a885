#include "conform/dut.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "conform/running_dut.hpp"
#include "io/json_members.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {

using io::Members;
using io::TextError;

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

std::vector<std::string> words_of(std::string_view text, const Places& places,
                                  std::span<const char* const> needed) {
  WordReader reader(text);
  std::vector<std::string> words;
  while (auto word = reader.next()) words.push_back(std::move(*word));
  if (reader.unfinished()) {
    throw TextError(io::shown_json(text) + ": unterminated quote in this command line");
  }
  if (words.empty()) throw TextError("the command line is empty");
  for (const char* place : needed) {
    if (text.find(place) == std::string_view::npos) {
      throw TextError(fmt::format("the command {} does not have {}", io::shown_json(text), place));
    }
  }
  return fill_in(words, places);
}

constexpr std::string_view kLines = "lines:";
constexpr const char* kCommandPlaces[] = {"{input}", "{output}"};
constexpr const char* kMapPlaces[] = {"{input}", "{output}", "{view_row}", "{view_col}"};
constexpr const char* kTracePlaces[] = {"{input}", "{view_row}", "{view_col}",
                                        "{plane}", "{block_x}",  "{block_y}"};

bool takes_cameras(const std::string& command) {
  return command.find("{record}") != command.npos || command.find("{camera}") != command.npos;
}

// A command line that takes cameras draws frames, another one decodes all views.
void set_command(Dut& dut, const std::string& text, const Places& places) {
  dut.command = words_of(text, places, kCommandPlaces);
  if (takes_cameras(text)) dut.frame = dut.command;
}

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

// A declaration as it is written: a Dut whose command lines are not yet split into words.
struct Declaration {
  Dut dut;
  std::optional<std::string> command{};
  std::optional<std::string> lines{};
  std::optional<std::string> library{};
  std::optional<std::string> trace{};
  std::optional<std::string> frame{};
  std::optional<std::string> disparity{};
  std::string comment{};
};

void set_program(Dut& dut, const Declaration& declared, const Places& places) {
  const auto& command = declared.command ? declared.command : declared.frame;
  if (command.has_value() + declared.lines.has_value() + declared.library.has_value() != 1) {
    throw TextError(
        "exactly one of \"command\" (or of a renderer \"frame\"), \"lines\" and \"library\" is "
        "needed");
  }
  if (declared.library)
    return set_library(dut, fill_in({*declared.library}, places).front(), places);
  if (declared.lines) return set_lines(dut, words_of(*declared.lines, places, {}));
  set_command(dut, *command, places);
  if (declared.frame) {
    dut.frame = words_of(*declared.frame, places, kCommandPlaces);
    if (!takes_cameras(*declared.frame)) {
      throw TextError("the command " + io::shown_json(*declared.frame) +
                      " has neither {record} nor {camera}");
    }
  }
  if (declared.disparity) dut.disparity = words_of(*declared.disparity, places, kMapPlaces);
  if (declared.trace) dut.trace = words_of(*declared.trace, places, kTracePlaces);
}

}  // namespace

static void visit(const Members& m, Waiver& waiver) {
  m("vector", waiver.vector);
  m("reason", waiver.reason);
  m.refuse_others("a waiver");
  if (!waiver.reason.empty()) return;
  throw TextError("the waiver of " + io::shown_json(waiver.vector) + " has no reason");
}

static void visit(const Members& m, Declaration& declared) {
  Dut& dut = declared.dut;
  m("name", dut.name);
  m("command", declared.command);
  m("lines", declared.lines);
  m("library", declared.library);
  m("trace", declared.trace);
  m("frame", declared.frame);
  m("disparity", declared.disparity);
  m.given("by_block", dut.by_block);
  visit(m, dut.claims);
  visit_renderer(m, dut.claims);
  m.given("error_names", dut.error_names);
  m.given("checks_sections", dut.checks_sections);
  m.given("waivers", dut.waivers);
  m.given("comment", declared.comment);
  m.refuse_others("the declaration");
}

static Dut read_declaration(const std::filesystem::path& file, Places places) {
  auto json = io::read_json_file<Members::Json>(file, kDeclarationLimits);
  if (!json) throw TextError(json.error().message);
  Declaration declared;
  visit(Members(*json, true), declared);
  places["dut"] = std::filesystem::absolute(file).parent_path().string();
  set_program(declared.dut, declared, places);
  return std::move(declared.dut);
}

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
    dut.text = text;
    dut.name = io::valid_utf8(text);
    if (path.extension() == ".so") {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(path, ignored)) throw TextError("no such library");
      set_library(dut, std::filesystem::absolute(path).string(), names);
    } else if (text.starts_with(kLines)) {
      set_lines(dut, words_of(std::string_view(text).substr(kLines.size()), names, {}));
    } else {
      set_command(dut, text, names);
    }
    return dut;
  } catch (const TextError& error) {
    return io::file_error(text, error.what());
  }
}

}  // namespace hmlfc::conform
