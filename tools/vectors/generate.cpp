#include "vectors/generate.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <iterator>
#include <new>
#include <set>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "io/files.hpp"
#include "syntax/header.hpp"
#include "vectors/base_vector.hpp"
#include "vectors/digest.hpp"
#include "vectors/expected.hpp"
#include "vectors/frame_vector.hpp"
#include "vectors/header_recipe.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::vectors {

namespace {

std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

SuiteFile add_file(SuiteFiles& files, const std::string& name, std::vector<uint8_t> bytes) {
  SuiteFile file{FileName(name), bytes.size(), sha256(bytes)};
  files[name] = std::move(bytes);
  return file;
}

ViewSum view_sum(const StreamHeader& header, const std::vector<uint8_t>& raw) {
  return {sha256(raw),   header.rows,  header.cols,         header.width,
          header.height, header.depth, header.chroma_format};
}

// Where codestream number `codestream` of the recipe begins in the TOP section.
uint64_t codestream_offset(const SectionEntry& top, const Json& json, const MadeStream& made) {
  const uint64_t at = top.offset + json["codestream"].get<uint64_t>() * kTopEntryBytes;
  return load_le<uint64_t>(made.bytes, static_cast<size_t>(at));
}

// The byte that a recipe states as the place of the error.
uint64_t offset_of(const Json& json, const MadeStream& made) {
  if (!json.is_object()) return json.is_null() ? 0 : json.get<uint64_t>();
  if (json.contains("end")) {
    return made.bytes.size() - json["end"].get<uint64_t>();
  }
  for (const SectionEntry* entry : section_entries(made.header)) {
    if (json.at("section") != section_name(static_cast<Section>(entry->type))) continue;
    if (json.contains("codestream")) return entry->offset + codestream_offset(*entry, json, made);
    return entry->offset + json.value("plus", uint64_t{0});
  }
  throw TextError(json["section"].dump() + " is not a section");
}

[[noreturn]] void contradict(const std::string& id, const Expectation& expect,
                             const std::string& answer) {
  throw TextError(fmt::format("{}: the recipe expects {} at byte {}, the golden model answers {}",
                              id, error_name(expect.error), expect.offset, answer));
}

// Throws unless `error` is what `expect` states.
void check_error(const std::string& id, const Expectation& expect, const Error& error) {
  if (error.code == expect.error && error.offset == expect.offset) return;
  contradict(id, expect, to_string(error));
}

void check_blocks(const std::string& id, const Expectation& expect, const Decoder& decoder) {
  for (const BlockAddress& block : expect.blocks) {
    const auto samples = decoder.decode_block(block);
    if (samples) contradict(id, expect, "samples");
    check_error(id, expect, samples.error());
  }
}

// Expected pictures come from the fast path: throws unless the golden path has the same samples.
void require_golden(const std::string& id, const Decoder& decoder) {
  const uint32_t side = decoder.header().block_size();
  for_each_block(decoder, [&](const BlockAddress& block) {
    const PlaneSize size = decoder.plane_size(block.plane);
    const Rect rect{block.bx * side, block.by * side, std::min(side, size.width - block.bx * side),
                    std::min(side, size.height - block.by * side)};
    const auto fast = decoder.decode_rect(block.view, block.plane, rect);
    const auto golden = decoder.decode_block(block);
    bool same = fast.has_value() == golden.has_value();
    for (size_t i = 0; fast && same && i < fast->size(); ++i) {
      same = (*fast)[i] == (*golden)[i / rect.width * side + i % rect.width];
    }
    if (!same) throw TextError(id + ": the golden and the fast path differ");
  });
}

// Flags for the states of blocks that the stream has: zero, residual, motion.
void add_state_flags(const Decoder& decoder, Vector& vector) {
  const auto statistics = decoder.statistics();
  if (!statistics) return;
  const auto count = [&](BlockState state) {
    return statistics->states[static_cast<size_t>(state)];
  };
  const uint64_t both = count(BlockState::kMotionResidual);
  if (count(BlockState::kZero) != 0) vector.flags.emplace_back("zero");
  if (count(BlockState::kResidual) + both != 0) vector.flags.emplace_back("residual");
  if (count(BlockState::kMotion) + both != 0) vector.flags.emplace_back("motion");
}

// Sets the golden model's results for a stream that it opens.
void add_expected(const Recipe& recipe, const Decoder& decoder, SuiteFiles& files, Vector& vector) {
  require_golden(recipe.id, decoder);
  add_state_flags(decoder, vector);
  ExpectedViews expected = expected_views(decoder);
  const bool all = recipe.expect.operation == Operation::kOpen;
  if (all != expected.raw.has_value()) {
    throw TextError(recipe.id + (all ? ": a block does not decode" : ": all blocks decode"));
  }
  if (expected.raw) vector.output = view_sum(decoder.header(), *expected.raw);
  vector.blocks = add_file(files, recipe.id + ".blocks", bytes_of(expected.blocks));
  if (recipe.trace.empty()) return;
  const TraceText trace = trace_text(decoder, recipe.trace);
  vector.trace = TraceFiles{add_file(files, recipe.id + ".trace.jsonl", bytes_of(trace.lines)),
                            add_file(files, recipe.id + ".trace.hex", bytes_of(trace.hex))};
}

std::vector<FileName> files_of(const Vector& vector) {
  std::vector<FileName> names{vector.input.file};
  if (vector.blocks) names.push_back(vector.blocks->file);
  if (vector.trace) names.insert(names.end(), {vector.trace->lines.file, vector.trace->hex.file});
  return names;
}

constexpr uint64_t kSeed = 1;

// Calls make(i) for i in [0, count) on `threads` threads. Throws TextError with all that they
// throw.
void make_all(size_t count, unsigned threads, const io::Progress& progress,
              const std::function<void(size_t)>& make) {
  std::vector<std::string> failures(count);
  io::for_each_index(count, threads, progress, [&](size_t i) {
    try {
      make(i);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      failures[i] = error.what();
    }
  });
  std::erase(failures, "");
  if (!failures.empty()) throw TextError(fmt::format("{}", fmt::join(failures, "\n")));
}

// Throws TextError.
SuiteFiles make_suite(const std::filesystem::path& folder, unsigned threads,
                      const io::Progress& progress) {
  const Recipes recipes = read_recipes(folder);
  std::vector<std::string> ids;
  for (const auto& [id, recipe] : recipes) ids.push_back(id);
  std::vector<Vector> vectors(ids.size());
  std::vector<SuiteFiles> parts(ids.size());
  make_all(ids.size(), threads, progress,
           [&](size_t i) { vectors[i] = make_vector(recipes, ids[i], parts[i]); });
  SuiteFiles files;
  Manifest manifest{kVectorsVersion, kVersion, "hmlfc vectors generate", kSeed, {},
                    kFramesVersion,  {}};
  for (size_t i = 0; i < ids.size(); ++i) {
    if (!recipes.at(ids[i]).listed) continue;
    files.merge(parts[i]);
    manifest.vectors.push_back(std::move(vectors[i]));
  }
  for (Vector& vector : manifest.vectors) {
    vector.milestone = milestone_of(vector);
    if (vector.expect.outcome == Outcome::kOk) continue;
    vector.base = base_of(vector, recipes, manifest.vectors);
  }
  const auto frames = read_frame_recipes(folder);
  manifest.frames.resize(frames.size());
  make_all(frames.size(), threads, {}, [&](size_t i) {
    const auto& [id, recipe] = *std::next(frames.begin(), static_cast<std::ptrdiff_t>(i));
    manifest.frames[i] = make_frame_vector(id, recipe, manifest.vectors, files);
  });
  const std::string text = manifest_text(std::move(manifest));
  files["manifest.json"] = bytes_of(text);
  return files;
}

}  // namespace

Vector make_vector(const Recipes& recipes, const std::string& id, SuiteFiles& files) {
  const Recipe& recipe = recipes.at(id);
  const MadeStream made = make_stream(recipes, id);
  // An edited header, if it can be read, describes the stream.
  const StreamHeader header = parse_header(made.bytes).value_or(made.header);
  Vector vector;
  vector.id = VectorId(id);
  vector.group = recipe.group;
  vector.profile = header.profile;
  vector.level = conformance_level(header);
  vector.clauses = recipe.clauses;
  vector.flags = header_flags(header);
  vector.flags.insert(vector.flags.end(), recipe.flags.begin(), recipe.flags.end());
  vector.comment = recipe.comment;
  vector.expect = recipe.expect;
  vector.expect.offset = offset_of(recipe.offset, made);

  const bool opens =
      recipe.expect.outcome == Outcome::kOk || recipe.expect.operation == Operation::kBlock;
  const auto decoder = Decoder::open(made.bytes);
  if (opens && !decoder) throw TextError(id + ": " + to_string(decoder.error()));
  if (!opens) {
    if (decoder) contradict(id, vector.expect, "an open stream");
    check_error(id, vector.expect, decoder.error());
  } else {
    check_blocks(id, vector.expect, *decoder);
    add_expected(recipe, *decoder, files, vector);
  }
  if (recipe.expect.outcome == Outcome::kAcceptable) {
    const auto lenient = Decoder::open(made.bytes, {.check_sections = false});
    if (lenient) add_expected(recipe, *lenient, files, vector);
  }
  vector.input = add_file(files, id + ".hmlfc", made.bytes);
  return vector;
}

io::IoResult<SuiteFiles> generate_suite(const std::filesystem::path& folder, unsigned threads,
                                        const io::Progress& progress) {
  try {
    return make_suite(folder, threads, progress);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return tl::unexpected(io::IoError{error.what()});
  }
}

// A suite is written and removed in place: no link below its folder leads out of it.
static io::IoResult<void> refuse_links(const std::filesystem::path& folder,
                                       const std::filesystem::path& name) {
  for (auto path = name; !path.empty(); path = path.parent_path()) {
    if (std::filesystem::is_symlink(folder / path)) {
      return io::file_error(folder / path, "is a link, which may lead anywhere; remove it first");
    }
  }
  return {};
}

io::IoResult<void> write_suite(const SuiteFiles& files, const std::filesystem::path& folder) {
  std::set<std::string> removed;
  const auto earlier = read_manifest(folder);
  for (size_t i = 0; earlier && i < earlier->vectors.size(); ++i) {
    for (const FileName& name : files_of(earlier->vectors[i])) {
      if (!files.contains(name.text())) removed.insert(name.text());
    }
  }
  for (const std::string& name : removed) {
    if (auto ok = refuse_links(folder, name); !ok) return ok;
  }
  for (const auto& [name, bytes] : files) {
    if (auto ok = refuse_links(folder, name); !ok) return ok;
  }
  std::error_code error;
  for (const auto& [name, bytes] : files) {
    const auto group = (folder / name).parent_path();
    std::filesystem::create_directories(group, error);
    if (error) return io::system_error(group, "cannot be created", error.value());
    if (auto ok = io::write_file(folder / name, bytes); !ok) return ok;
  }
  for (const std::string& name : removed) {
    std::filesystem::remove(folder / name, error);
    if (error) return io::system_error(folder / name, "cannot be removed", error.value());
  }
  return {};
}

}  // namespace hmlfc::vectors
