#include "vectors/manifest.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <set>
#include <utility>

#include "io/format_json.hpp"
#include "vectors/json.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc {

static void visit(const io::Members& m, ErrorCode& code) {
  if (!m.reading()) return static_cast<void>(m.json() = error_name(code));
  const auto name = m.json().get<std::string>();
  const auto error = vectors::error_from_name(name);
  if (!error) throw io::TextError(io::shown_json(name) + " is not an error of annex A");
  code = *error;
}

static void visit(const io::Members& m, BlockAddress& block) {
  m("plane", block.plane);
  m("view_row", block.view.row);
  m("view_col", block.view.col);
  m("block_x", block.bx);
  m("block_y", block.by);
}

namespace vectors {
namespace {

constexpr std::array<std::string_view, 3> kOutcomes{"ok", "reject", "acceptable"};
constexpr std::array<std::string_view, 2> kOperations{"open", "block"};

}  // namespace

static void visit(const Members& m, Outcome& outcome) { m.as_name(outcome, kOutcomes); }

static void visit(const Members& m, Operation& operation) { m.as_name(operation, kOperations); }

static void visit(const Members& m, Expectation& expect) {
  m("outcome", expect.outcome);
  if (expect.outcome == Outcome::kOk) return;
  m.unless_empty("input", expect.input);
  if (!expect.input.empty()) return;
  m("error", expect.error);
  m("offset", expect.offset);
  m("operation", expect.operation);
  if (!m.reading() && expect.operation == Operation::kOpen) return;
  m.given("blocks", expect.blocks);
}

static void visit(const Members& m, ViewSum& output) {
  m("sha256", output.sha256);
  m("rows", output.rows);
  m("cols", output.cols);
  m("width", output.width);
  m("height", output.height);
  m("depth", output.depth);
  m("chroma", output.chroma);
}

static void visit(const Members& m, SuiteFile& file) {
  m("file", file.file);
  m("sha256", file.sha256);
}

static void visit(const Members& m, TraceFiles& trace) {
  visit(m, trace.lines);
  m("hex_file", trace.hex.file);
  m("hex_sha256", trace.hex.sha256);
}

static void visit(const Members& m, Vector& vector) {
  m("id", vector.id);
  m("group", vector.group);
  m("profile", vector.profile);
  m("level", vector.level);
  m("clauses", vector.clauses);
  m("flags", vector.flags);
  m("comment", vector.comment);
  m("milestone", vector.milestone);
  if (m.reading()) {
    const auto number = milestone_number(vector.milestone);
    if (!number) throw TextError(io::shown_json(vector.milestone) + " is not a milestone");
    vector.milestone = milestones_with(vector.milestone)[*number].name;
  }
  const Members input = m.at("input");
  input("file", vector.input.file);
  input("bytes", vector.input.bytes);
  input("sha256", vector.input.sha256);
  m("expect", vector.expect);
  m("base", vector.base);
  m("output", vector.output);
  m("blocks", vector.blocks);
  m("trace", vector.trace);
  if (m.reading() && (m.has("camera") || m.has("map"))) vector.frame.emplace();
  if (vector.frame) visit(m, *vector.frame);
}

static void visit(const Members& m, Manifest& manifest) {
  m("vectors_version", manifest.vectors_version);
  m("stream_version", manifest.stream_version);
  m("generator", manifest.generator);
  m("seed", manifest.seed);
  m.given("frames_version", manifest.frames_version);  // suites before 3.4.0 have no frames
}

namespace {

// Throws unless ids are unique, and exactly the vectors that need not decode have a base, which
// decodes.
void check_ids(const std::vector<Vector>& vectors) {
  std::set<VectorId> ids;
  std::set<VectorId> decode;
  for (const Vector& vector : vectors) {
    if (!ids.insert(vector.id).second) throw TextError("two vectors " + vector.id.text());
    if (vector.expect.outcome == Outcome::kOk) decode.insert(vector.id);
  }
  for (const Vector& vector : vectors) {
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

// Throws unless a frame or map has a sum exactly where it is to come, and else an input or a block.
void check_frame(const Vector& vector) {
  const FrameCase& frame = *vector.frame;
  const bool ok = vector.expect.outcome == Outcome::kOk;
  const std::string sum = frame.map ? frame.map->sha256 : frame.frame ? frame.frame->sha256 : "";
  if (sum.size() != (ok ? 64 : 0)) throw TextError("its outcome and its sha256 do not fit");
  if (!ok && vector.expect.input.empty() == vector.expect.blocks.empty()) {
    throw TextError("its error has neither an input nor a block");
  }
}

std::vector<Vector> vectors_from(Json& list, bool frames) {
  std::vector<Vector> vectors;
  for (Json& vector : list) {
    const std::string number = std::to_string(vectors.size());
    try {
      visit(Members(vector, true), vectors.emplace_back());
      if (vectors.back().frame.has_value() != frames) {
        throw TextError(frames ? "is neither a frame nor a map" : "is for renderers");
      }
      if (frames) check_frame(vectors.back());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw TextError("vector " + io::shown_json(vector.value("id", number)) + ": " + error.what());
    }
  }
  check_ids(vectors);
  return vectors;
}

Manifest manifest_from(Json json) {
  Manifest manifest;
  visit(Members(json, true), manifest);
  manifest.vectors = vectors_from(json.at("vectors"), false);
  if (json.contains("frames")) manifest.frames = vectors_from(json["frames"], true);
  if (json.at("count") != manifest.vectors.size()) {
    throw TextError("count is not the number of vectors");
  }
  return manifest;
}

Json json_of(const std::vector<MilestoneRow>& rows) {
  Json list = Json::array();
  for (const MilestoneRow& row : rows) list.push_back({{"name", row.name}, {"claim", row.claim}});
  return list;
}

Json json_of(std::vector<Vector>& vectors) {
  Json list = Json::array();
  for (Vector& vector : vectors) visit(Members(list.emplace_back(), false), vector);
  return list;
}

}  // namespace

Manifest frames_of(Manifest manifest) {
  manifest.vectors = std::move(manifest.frames);
  manifest.vectors_version = manifest.frames_version;
  return manifest;
}

std::string_view outcome_name(Outcome outcome) { return kOutcomes[static_cast<size_t>(outcome)]; }

std::optional<ErrorCode> error_from_name(std::string_view name) {
  for (int code = 0; code < kErrorCodeCount; ++code) {
    if (error_name(static_cast<ErrorCode>(code)) == name) return static_cast<ErrorCode>(code);
  }
  return std::nullopt;
}

io::IoResult<Manifest> read_manifest(const std::filesystem::path& folder) {
  const auto file = folder / "manifest.json";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return io::file_error(
        folder,
        "no conformance suite is here, for want of manifest.json; --suite names its folder");
  }
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
  visit(Members(json, false), manifest);
  json["count"] = manifest.vectors.size();
  json["milestones"] = json_of(milestones());
  json["frame_milestones"] = json_of(frame_milestones());
  json["vectors"] = json_of(manifest.vectors);
  json["frames"] = json_of(manifest.frames);
  return json.dump(2) + "\n";
}

}  // namespace vectors
}  // namespace hmlfc
