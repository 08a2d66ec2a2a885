// Reports for machines and people.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "conform/result.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// One page without other files: counts, failures with their pictures (read from `folder`), clauses
/// by decoder, all results.
std::string html_text(const Report& report, const std::filesystem::path& folder);

/// JUnit XML for CI servers: a test suite for each decoder, a test case for each vector.
std::string junit_text(const Report& report);

/// `text` escaped for HTML and XML; control characters become '?'.
std::string escaped(std::string_view text);

/// What a terminal shows of one decoder: the verdict, where to begin, failures by probable cause.
std::string terminal_text(const Run& run);

/// Writes report.json, junit.xml and report.html into `folder`.
io::IoResult<void> write_report(const Report& report, const std::filesystem::path& folder);

/// This system; `program` is this program's name and version.
SystemInfo this_system(const std::string& program);

/// A report of `folder` to be merged with others.
struct ReportPart {
  std::filesystem::path folder;
  Report report;
};

/// Merges all parts. Shards of one decoder become one run, in which a vector has the result of the
/// part that ran it (the worst if several did); each decoder has its own run. Pictures of failures
/// are copied into `folder`. Errors: parts of different suites, two decoders with one folder, no
/// part, cannot write.
io::IoResult<Report> merge(const std::vector<ReportPart>& parts,
                           const std::filesystem::path& folder);

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// One result, without keys that have their default.
Json to_json(const VectorResult& result);

/// Reads one result of decoder `dut`; nothing if `json` is not one.
std::optional<VectorResult> result_from_json(Json json, const std::string& dut);

/// The whole report with counts and verdicts; docs/conformance.md has its keys.
Json to_json(const Report& report);

/// Reads a file of to_json(report). Errors: not readable, not such a file.
io::IoResult<Report> read_report(const std::filesystem::path& file);

}  // namespace hmlfc::conform
