#include "vectors/manifest.hpp"

#include <array>
#include <utility>

#include "vectors/json.hpp"

namespace hmlfc::vectors {
namespace {

constexpr std::array<std::string_view, 3> kOutcomes{"ok", "reject", "acceptable"};
constexpr std::array<std::string_view, 2> kOperations{"open", "block"};
constexpr std::array<std::string_view, 2> kProfiles{"main", "extended"};
constexpr std::array<std::string_view, 2> kChromaFormats{"420", "444"};
constexpr std::array<std::string_view, 3> kPlaneNames{"Y", "Co", "Cg"};

// The value whose name is the text at `key`.
template <class T, size_t kCount>
T named(const Json& json, const char* key, const std::array<std::string_view, kCount>& names) {
  const auto text = json.at(key).get<std::string>();
  for (size_t i = 0; i < kCount; ++i) {
    if (names[i] == text) return static_cast<T>(i);
  }
  throw TextError("\"" + text + "\" is not a value of " + key);
}

Json block_json(const BlockAddress& block) {
  return {{"plane", plane_name(block.plane)},
          {"view_row", block.view.row},
          {"view_col", block.view.col},
          {"block_x", block.bx},
          {"block_y", block.by}};
}

BlockAddress block_from(const Json& json) {
  return {{json.at("view_row"), json.at("view_col")},
          named<Plane>(json, "plane", kPlaneNames),
          json.at("block_x"),
          json.at("block_y")};
}

Json expect_json(const Expectation& expect) {
  Json json;
  json["outcome"] = outcome_name(expect.outcome);
  if (expect.outcome == Outcome::kOk) return json;
  json["error"] = error_name(expect.error);
  json["offset"] = expect.offset;
  json["operation"] = operation_name(expect.operation);
  if (expect.operation == Operation::kOpen) return json;
  Json& blocks = json["blocks"] = Json::array();
  for (const BlockAddress& block : expect.blocks) blocks.push_back(block_json(block));
  return json;
}

Expectation expect_from(const Json& json) {
  Expectation expect;
  expect.outcome = named<Outcome>(json, "outcome", kOutcomes);
  if (expect.outcome == Outcome::kOk) return expect;
  const auto name = json.at("error").get<std::string>();
  const auto error = error_from_name(name);
  if (!error) throw TextError("\"" + name + "\" is not an error of annex A");
  expect.error = *error;
  expect.offset = json.at("offset");
  expect.operation = named<Operation>(json, "operation", kOperations);
  for (const Json& block : json.value("blocks", Json::array())) {
    expect.blocks.push_back(block_from(block));
  }
  return expect;
}

Json output_json(const ViewSum& output) {
  return {{"sha256", output.sha256},
          {"rows", output.rows},
          {"cols", output.cols},
          {"width", output.width},
          {"height", output.height},
          {"depth", output.depth},
          {"chroma", kChromaFormats[static_cast<size_t>(output.chroma)]}};
}

ViewSum output_from(const Json& json) {
  return {json.at("sha256"),
          json.at("rows"),
          json.at("cols"),
          json.at("width"),
          json.at("height"),
          json.at("depth"),
          named<ChromaFormat>(json, "chroma", kChromaFormats)};
}

Json trace_json(const TraceFiles& trace) {
  return {{"file", trace.lines.file},
          {"sha256", trace.lines.sha256},
          {"hex_file", trace.hex.file},
          {"hex_sha256", trace.hex.sha256}};
}

Json vector_json(const Vector& vector) {
  Json json;
  json["id"] = vector.id;
  json["group"] = vector.group;
  json["profile"] = profile_name(vector.profile);
  json["level"] = vector.level;
  json["clauses"] = vector.clauses;
  json["flags"] = vector.flags;
  json["comment"] = vector.comment;
  json["input"] = {
      {"file", vector.input.file}, {"bytes", vector.input.bytes}, {"sha256", vector.input.sha256}};
  json["expect"] = expect_json(vector.expect);
  if (vector.output) json["output"] = output_json(*vector.output);
  if (vector.blocks) {
    json["blocks"] = {{"file", vector.blocks->file}, {"sha256", vector.blocks->sha256}};
  }
  if (vector.trace) json["trace"] = trace_json(*vector.trace);
  return json;
}

SuiteFile file_from(const Json& json, const char* file = "file", const char* sum = "sha256") {
  return {json.at(file), json.value("bytes", uint64_t{0}), json.at(sum)};
}

Vector vector_from(const Json& json) {
  Vector vector;
  vector.id = json.at("id");
  vector.group = json.at("group");
  vector.profile = named<Profile>(json, "profile", kProfiles);
  vector.level = json.at("level");
  vector.clauses = json.at("clauses");
  vector.flags = json.at("flags");
  vector.comment = json.at("comment");
  vector.input = file_from(json.at("input"));
  vector.expect = expect_from(json.at("expect"));
  if (json.contains("output")) vector.output = output_from(json["output"]);
  if (json.contains("blocks")) vector.blocks = file_from(json["blocks"]);
  if (json.contains("trace")) {
    const Json& trace = json["trace"];
    vector.trace = TraceFiles{file_from(trace), file_from(trace, "hex_file", "hex_sha256")};
  }
  return vector;
}

Manifest manifest_from(const Json& json) {
  Manifest manifest;
  manifest.vectors_version = json.at("vectors_version");
  manifest.stream_version = json.at("stream_version");
  manifest.generator = json.at("generator");
  manifest.seed = json.at("seed");
  for (const Json& vector : json.at("vectors")) {
    try {
      manifest.vectors.push_back(vector_from(vector));
    } catch (const std::exception& error) {
      throw TextError("vector " + vector.value("id", std::to_string(manifest.vectors.size())) +
                      ": " + error.what());
    }
  }
  if (json.at("count") != manifest.vectors.size()) {
    throw TextError("count is not the number of vectors");
  }
  return manifest;
}

}  // namespace

std::string_view outcome_name(Outcome outcome) { return kOutcomes[static_cast<size_t>(outcome)]; }

std::string_view operation_name(Operation operation) {
  return kOperations[static_cast<size_t>(operation)];
}

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
  } catch (const std::exception& error) {
    const std::string text = error.what();
    if (text.starts_with(file.string())) return tl::unexpected(io::IoError{text});
    return io::file_error(file, text);
  }
}

std::string manifest_text(const Manifest& manifest) {
  Json json;
  json["vectors_version"] = manifest.vectors_version;
  json["stream_version"] = manifest.stream_version;
  json["generator"] = manifest.generator;
  json["seed"] = manifest.seed;
  json["count"] = manifest.vectors.size();
  Json& vectors = json["vectors"] = Json::array();
  for (const Vector& vector : manifest.vectors) vectors.push_back(vector_json(vector));
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::vectors
