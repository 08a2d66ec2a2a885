// Reports as JSON, written and read.
#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "conform/result.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// JSON with its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// One result; absent keys have their default.
Json to_json(const VectorResult& result);

/// Nothing where `json` is no result.
std::optional<VectorResult> result_from_json(const Json& json);

/// The whole report with counts and verdicts; docs/conformance.md has its keys.
Json to_json(const Report& report);

/// Reads a file of to_json(report). Errors: not readable, not such a file.
io::IoResult<Report> read_report(const std::filesystem::path& file);

}  // namespace hmlfc::conform
