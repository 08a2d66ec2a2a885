// Results of conformance vectors, the verdict on them, and their log.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conform/difference.hpp"
#include "conform/dut.hpp"
#include "io/files.hpp"
#include "io/io_error.hpp"
#include "vectors/suite_name.hpp"

namespace hmlfc::conform {

/// Of words in messages.
inline constexpr std::string_view kWordCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

/// The outcome of one vector.
enum class Status : uint8_t {
  kPass,          ///< exactly what the manifest says
  kFail,          ///< something else
  kError,         ///< the decoder could not be started, crashed, or the suite is damaged
  kTimeout,       ///< the decoder did not end within its time
  kNotSupported,  ///< beyond what the decoder claims; not required of it
  kSkipped,       ///< required, but not run
};
inline constexpr size_t kStatusCount = 6;

inline constexpr std::array<std::string_view, kStatusCount> kStatusNames{
    "pass", "fail", "error", "timeout", "not_supported", "skipped"};

/// One of kStatusNames.
constexpr std::string_view status_name(Status status) {
  return kStatusNames[static_cast<size_t>(status)];
}

/// One vector on one decoder.
struct VectorResult {
  vectors::VectorId id;
  Status status = Status::kSkipped;
  std::string reason;  ///< one sentence; empty for a pass
  std::string kind;    ///< the reason without places and values, or empty
  std::optional<Difference> difference;
  std::string stage;     ///< the first wrong stage where the decoder gives traces, or empty
  std::string messages;  ///< the end of its standard error; not kept for a pass
  double seconds = 0;
  std::string pictures;  ///< pictures_of() the failure, or empty
  std::string waiver;    ///< why a failure is accepted, or empty
  std::vector<std::string> clauses;
  std::string comment;       ///< the mistake that the vector hunts
  std::string milestone;     ///< of the manifest
  uint64_t bytes = 0;        ///< of the stream
  bool telling = false;      ///< several views and blocks show what is wrong (runner.cpp)
  std::string inspect;       ///< the command that shows what the decoder gets wrong, or empty
  std::string view;          ///< the command that opens the page on it next to the model, or empty
  bool not_counted = false;  ///< a refusal whose base does not pass

  bool bad() const {
    return status == Status::kFail || status == Status::kError || status == Status::kTimeout;
  }
  bool waived() const { return bad() && !waiver.empty(); }
};

/// One decoder on the suite: a result for each vector of the manifest, in its order.
struct Run {
  std::string dut;
  std::vector<std::string> command;
  std::string profile;  ///< that the decoder claims
  int level = 0;
  std::string milestone;  ///< the only one that was to be run; empty: all
  std::vector<VectorResult> results;
};

/// The system and time of a run.
struct SystemInfo {
  std::string program;    ///< name and version
  std::string date;       ///< UTC, ISO 8601
  std::string host;       ///< operating system and machine
  std::string processor;  ///< its model
  unsigned threads = 0;   ///< of the processor
  uint64_t memory_mib = 0;
};

/// Several decoders on one suite.
struct Report {
  std::string vectors_version;
  std::string manifest_sha256;
  SystemInfo system;
  std::vector<Run> runs;
};

/// How many vectors have each status; waived failures are counted apart.
struct Tally {
  uint64_t count[kStatusCount] = {};
  uint64_t waived = 0;

  uint64_t of(Status status) const { return count[static_cast<size_t>(status)]; }
  uint64_t bad() const { return of(Status::kFail) + of(Status::kError) + of(Status::kTimeout); }
};
Tally tally(const Run& run);

/// The verdict on a decoder.
enum class Verdict : uint8_t {
  kConforms,    ///< every required vector passes, but for waived ones
  kWhole,       ///< the same of the one milestone that was to be run
  kIncomplete,  ///< no failures, but required vectors were skipped, or there were none
  kFails,       ///< a required vector failed
};
Verdict verdict(const Run& run);

/// "conforms", "milestone NAME is whole", either "..., with waivers"; "incomplete" or "fails".
std::string verdict_text(const Run& run);

/// The file results.jsonl of a decoder's folder: a line that names the suite and the decoder, then
/// a line per result. Incomplete lines are ignored.
class ResultLog {
 public:
  /// Creates `folder` if it is missing. With `resume`, keeps the results of an existing file,
  /// except skipped ones; otherwise the file starts empty. Errors: cannot write; with `resume`,
  /// results of another suite or decoder.
  static io::IoResult<ResultLog> open(const std::filesystem::path& folder,
                                      const std::string& manifest_sha256, const Dut& dut,
                                      bool resume);

  /// The result of an earlier run, or null.
  const VectorResult* earlier(const vectors::VectorId& id) const;

  /// Errors: cannot write.
  io::IoResult<void> append(const VectorResult& result);

 private:
  ResultLog() = default;

  std::filesystem::path path_;
  io::FileDescriptor file_;
  std::map<vectors::VectorId, VectorResult> earlier_;
};

}  // namespace hmlfc::conform
