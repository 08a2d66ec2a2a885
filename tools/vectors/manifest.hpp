// The manifest of a conformance suite: which vectors there are and what a decoder must do with
// each (vectors/README.md).
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

#include "io/io_error.hpp"
#include "vectors/frame_case.hpp"
#include "vectors/suite_name.hpp"

namespace hmlfc::vectors {

/// What a decoder must do with a vector.
enum class Outcome : uint8_t {
  kOk,          ///< decode it to the expected samples
  kReject,      ///< report the error: when opening it, or for the blocks named
  kAcceptable,  ///< decode it to the expected samples, or report the error when opening it
};

/// The operation that reports the error of a rejected stream.
enum class Operation : uint8_t { kOpen, kBlock };

/// A file of the suite, in its folder.
struct SuiteFile {
  FileName file;
  uint64_t bytes = 0;  ///< in the manifest for inputs alone
  std::string sha256;  ///< 64 lower-case hexadecimal digits
};

struct Expectation {
  Outcome outcome = Outcome::kOk;
  ErrorCode error = ErrorCode::kOk;  ///< kOk where the outcome is kOk
  uint64_t offset = 0;               ///< byte from the start of the file where the error lies
  Operation operation = Operation::kOpen;
  std::vector<BlockAddress> blocks;  ///< with kBlock: blocks that must fail with the error; of a
                                     ///< frame or map the one whose error it has (NED-2, GEO-7)
  std::string input;                 ///< of a refused camera: the input to name; else empty
};

/// The decoded views (vectors/README.md, raw form).
struct ViewSum {
  std::string sha256;
  uint32_t rows = 0;
  uint32_t cols = 0;
  uint32_t width = 0;
  uint32_t height = 0;
  int depth = 8;
  ChromaFormat chroma = ChromaFormat::k420;
};

/// Traces of chosen blocks in both forms.
struct TraceFiles {
  SuiteFile lines;  ///< JSON lines
  SuiteFile hex;    ///< for $readmemh
};

struct Vector {
  VectorId id;
  std::string group;
  Profile profile = Profile::kMain;
  int level = 0;  ///< LVL-1
  std::vector<std::string> clauses;
  std::vector<std::string> flags;
  std::string comment;
  std::string milestone;  ///< milestone.hpp
  SuiteFile input;
  Expectation expect;
  std::optional<VectorId> base;     ///< unless ok: the vector that must pass before this counts
  std::optional<ViewSum> output;    ///< where all views decode
  std::optional<SuiteFile> blocks;  ///< where the stream can be opened
  std::optional<TraceFiles> trace;
  std::optional<FrameCase> frame;  ///< of Manifest::frames, and of these alone
};

struct Manifest {
  std::string vectors_version;
  int stream_version = 1;
  std::string generator;
  uint64_t seed = 1;
  std::vector<Vector> vectors;  ///< by id
  std::string frames_version;
  std::vector<Vector> frames;  ///< for renderers: group "frames", streams of `vectors`; by id

  /// The one of `vectors` with this id, or null.
  const Vector* find(const std::string& id) const {
    const auto at = std::ranges::find(vectors, id, [](const Vector& v) { return v.id.text(); });
    return at == vectors.end() ? nullptr : &*at;
  }
};

/// The same suite for renderers: its frames stand in place of the vectors.
Manifest frames_of(Manifest manifest);

/// "ok", "reject" or "acceptable".
std::string_view outcome_name(Outcome outcome);

/// The error of annex A with this name, or nothing.
std::optional<ErrorCode> error_from_name(std::string_view name);

/// manifest.json of the suite in `folder`. Errors: missing, not JSON, not a manifest, two
/// vectors of one id, or a base that is not a vector of outcome ok, with the place.
io::IoResult<Manifest> read_manifest(const std::filesystem::path& folder);

/// The text of manifest.json.
std::string manifest_text(Manifest manifest);

}  // namespace hmlfc::vectors
