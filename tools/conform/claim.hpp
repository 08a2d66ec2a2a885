// Claim files: that a decoder conforms to a suite, tied together by a hash, to be checked by
// running again (docs/conformance.md has the keys).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "conform/dut.hpp"
#include "conform/runner.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// A claim without its hash. Keys are sorted, so that its text is canonical.
using Claim = nlohmann::json;

/// What `dut`, which the user named as `dut_text`, claims on `suite`: all but the results. Errors:
/// a file of the decoder cannot be read.
io::IoResult<Claim> claim_of(const Suite& suite, const Dut& dut, const std::string& dut_text);

/// Adds the results of a run, how many pass of each milestone, the program that ran it and the
/// date.
void add_results(Claim& claim, const Run& run, const SystemInfo& system);

/// Writes {"claim": claim, "sha256": SHA-256 of the claim's text without blanks}. Errors: cannot
/// write.
io::IoResult<void> write_claim(const std::filesystem::path& file, const Claim& claim);

/// Reads a claim. Errors: not readable, not a claim, a hash that is not that of the claim.
io::IoResult<Claim> read_claim(const std::filesystem::path& file);

/// The first place of `claimed` at which `found` has another value, with both; nothing if they
/// agree. The date and the program are not compared, nor the results if `found` has none.
std::optional<std::string> claim_difference(const Claim& claimed, const Claim& found);

}  // namespace hmlfc::conform
