// Reports for machines and people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conform/result.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// JUnit XML: a test suite for each decoder, a test case for each vector.
std::string junit_text(const Report& report);

/// One page without other files: counts, failures with their pictures (read from `folder`), clauses
/// by decoder, all results.
std::string html_text(const Report& report, const std::filesystem::path& folder);

/// Writes report.json, junit.xml and report.html into `folder`.
io::IoResult<void> write_report(const Report& report, const std::filesystem::path& folder);

/// What runs on this machine; `program` is name and version of this one.
SystemInfo this_system(const std::string& program);

/// A report of `folder` to be merged with others.
struct ReportPart {
  std::filesystem::path folder;
  Report report;
};

/// One report of all parts: shards of one decoder become one run, in which a vector has the result
/// of the part that ran it (the worst where several did); other decoders follow each other. The
/// pictures of failures are copied into `folder`. Errors: parts of different suites, no part,
/// cannot write.
io::IoResult<Report> merge(const std::vector<ReportPart>& parts,
                           const std::filesystem::path& folder);

}  // namespace hmlfc::conform
