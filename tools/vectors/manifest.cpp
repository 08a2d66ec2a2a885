#include "vectors/manifest.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <set>
#include <utility>

#include "vectors/json.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::vectors {
namespace {

constexpr std::array<std::string_view, 3> kOutcomes{"ok", "reject", "acceptable"};
constexpr std::array<std::string_view, 2> kOperations{"open", "block"};
constexpr std::array<std::string_view, 2> kProfiles{"main", "extended"};
constexpr std::array<std::string_view, 2> kChromaFormats{"420", "444"};
constexpr std::array<std::string_view, 3> kPlaneNames{"Y", "Co", "Cg"};

// The members of a JSON object, read into values or written from them in this order.
struct Fields {
  Json& json;
  bool reading;

  Fields at(const char* key) const { return {reading ? json.at(key) : json[key], reading}; }

  template <class T>
  void operator()(const char* key, T& value) const {
    if constexpr (requires { visit(*this, value); }) {
      visit(at(key), value);
    } else if (!reading) {
      json[key] = value;
    } else if constexpr (std::is_integral_v<T>) {
      value = io::integer_at<T>(json, key);
    } else {
      json.at(key).get_to(value);
    }
  }

  template <class T>
  void operator()(const char* key, std::optional<T>& value) const {
    if (reading && json.contains(key)) value.emplace();
    if (value) (*this)(key, *value);
  }

  // An enumerator by its name.
  template <class T, size_t kCount>
  void operator()(const char* key, T& value,
                  const std::array<std::string_view, kCount>& names) const {
    if (!reading) {
      json[key] = names[static_cast<size_t>(value)];
      return;
    }
    const auto text = json.at(key).template get<std::string>();
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) throw TextError(io::shown_json(text) + " is not a value of " + key);
    value = static_cast<T>(found - names.begin());
  }
};

template <NameOf kOf>
void visit(const Fields& f, SuiteName<kOf>& name) {
  if (f.reading) {
    name = SuiteName<kOf>(f.json.get<std::string>());
  } else {
    f.json = name.text();
  }
}

void visit(const Fields& f, ErrorCode& code) {
  if (!f.reading) {
    f.json = error_name(code);
    return;
  }
  const auto name = f.json.get<std::string>();
  const auto error = error_from_name(name);
  if (!error) throw TextError(io::shown_json(name) + " is not an error of annex A");
  code = *error;
}

void visit(const Fields& f, BlockAddress& block) {
  f("plane", block.plane, kPlaneNames);
  f("view_row", block.view.row);
  f("view_col", block.view.col);
  f("block_x", block.bx);
  f("block_y", block.by);
}

void visit(const Fields& f, Expectation& expect) {
  f("outcome", expect.outcome, kOutcomes);
  if (expect.outcome == Outcome::kOk) return;
  f("error", expect.error);
  f("offset", expect.offset);
  f("operation", expect.operation, kOperations);
  if (!f.reading && expect.operation == Operation::kOpen) return;
  Json& blocks = f.json["blocks"];
  if (f.reading) {
    expect.blocks.resize(blocks.size());
  } else {
    blocks = Json::array();
  }
  for (size_t i = 0; i < expect.blocks.size(); ++i) {
    visit(Fields{blocks[i], f.reading}, expect.blocks[i]);
  }
}

void visit(const Fields& f, ViewSum& output) {
  f("sha256", output.sha256);
  f("rows", output.rows);
  f("cols", output.cols);
  f("width", output.width);
  f("height", output.height);
  f("depth", output.depth);
  f("chroma", output.chroma, kChromaFormats);
}

void visit(const Fields& f, SuiteFile& file) {
  f("file", file.file);
  f("sha256", file.sha256);
}

void visit(const Fields& f, TraceFiles& trace) {
  visit(f, trace.lines);
  f("hex_file", trace.hex.file);
  f("hex_sha256", trace.hex.sha256);
}

void visit(const Fields& f, Vector& vector) {
  f("id", vector.id);
  f("group", vector.group);
  f("profile", vector.profile, kProfiles);
  f("level", vector.level);
  f("clauses", vector.clauses);
  f("flags", vector.flags);
  f("comment", vector.comment);
  f("milestone", vector.milestone);
  if (f.reading && !milestone_number(vector.milestone)) {
    throw TextError(io::shown_json(vector.milestone) + " is not a milestone");
  }
  const Fields input = f.at("input");
  input("file", vector.input.file);
  input("bytes", vector.input.bytes);
  input("sha256", vector.input.sha256);
  f("expect", vector.expect);
  f("base", vector.base);
  f("output", vector.output);
  f("blocks", vector.blocks);
  f("trace", vector.trace);
}

void visit(const Fields& f, Manifest& manifest) {
  f("vectors_version", manifest.vectors_version);
  f("stream_version", manifest.stream_version);
  f("generator", manifest.generator);
  f("seed", manifest.seed);
}

// Throws unless ids are unique, and exactly the vectors that need not decode have a base, which
// decodes.
void check_ids(const Manifest& manifest) {
  std::set<VectorId> ids;
  std::set<VectorId> decode;
  for (const Vector& vector : manifest.vectors) {
    if (!ids.insert(vector.id).second) throw TextError("two vectors " + vector.id.text());
    if (vector.expect.outcome == Outcome::kOk) decode.insert(vector.id);
  }
  for (const Vector& vector : manifest.vectors) {
    if (vector.base.has_value() != (vector.expect.outcome != Outcome::kOk)) {
      throw TextError("vector " + vector.id.text() + ": its outcome and its base do not fit");
    }
    if (!vector.base) continue;
    if (!decode.contains(*vector.base)) {
      throw TextError("vector " + vector.id.text() + ": its base " + vector.base->text() +
                      " is not a vector of outcome ok");
    }
  }
}

Manifest manifest_from(Json json) {
  Manifest manifest;
  visit(Fields{json, true}, manifest);
  for (Json& vector : json.at("vectors")) {
    const std::string number = std::to_string(manifest.vectors.size());
    try {
      visit(Fields{vector, true}, manifest.vectors.emplace_back());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw TextError("vector " + io::shown_json(vector.value("id", number)) + ": " + error.what());
    }
  }
  if (json.at("count") != manifest.vectors.size()) {
    throw TextError("count is not the number of vectors");
  }
  check_ids(manifest);
  return manifest;
}

}  // namespace

std::string_view outcome_name(Outcome outcome) { return kOutcomes[static_cast<size_t>(outcome)]; }

std::optional<ErrorCode> error_from_name(std::string_view name) {
  for (int code = 0; code < kErrorCodeCount; ++code) {
    if (error_name(static_cast<ErrorCode>(code)) == name) return static_cast<ErrorCode>(code);
  }
  return std::nullopt;
}

io::IoResult<Manifest> read_manifest(const std::filesystem::path& folder) {
  const auto file = folder / "manifest.json";
  try {
    return manifest_from(read_json(file));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    if (text.starts_with(file.string())) return tl::unexpected(io::IoError{text});
    return io::file_error(file, text);
  }
}

std::string manifest_text(Manifest manifest) {
  Json json;
  visit(Fields{json, false}, manifest);
  json["count"] = manifest.vectors.size();
  Json& steps = json["milestones"] = Json::array();
  for (const MilestoneRow& row : milestones()) {
    steps.push_back({{"name", row.name}, {"claim", row.claim}});
  }
  Json& vectors = json["vectors"] = Json::array();
  for (Vector& vector : manifest.vectors) visit(Fields{vectors.emplace_back(), false}, vector);
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::vectors
