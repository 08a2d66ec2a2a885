#include "conform/claim.hpp"

#include <cstdlib>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "conform/summary.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::conform {

namespace fs = std::filesystem;

namespace {

std::string sum_of_text(const std::string& text) {
  return vectors::sha256({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// The program that a command line starts; its first word if there is none.
fs::path program_of(const std::string& word) {
  const char* path = std::getenv("PATH");
  if (word.find('/') != std::string::npos || path == nullptr) return word;
  std::istringstream folders{std::string(path)};
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code ignored;
    if (fs::is_regular_file(fs::path(folder) / word, ignored)) return fs::path(folder) / word;
  }
  return word;
}

// The files that a command names: the decoder, and what runs it. This program, which runs
// libraries, counts only where it is the decoder.
std::vector<fs::path> files_of(const std::vector<std::string>& command) {
  std::error_code ignored;
  const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
  std::vector<fs::path> files;
  for (size_t i = 0; i < command.size(); ++i) {
    const fs::path file = i == 0 ? program_of(command[i]) : fs::path(command[i]);
    if (fs::is_regular_file(file, ignored)) files.push_back(file);
  }
  if (files.size() > 1) {
    std::erase_if(files, [&](const fs::path& file) { return fs::equivalent(file, self, ignored); });
  }
  return files;
}

constexpr io::JsonLimits kClaimLimits{"a claim", size_t{1} << 24, 5};

// Whether the parts are there that are looked at before the claims are compared.
bool is_claim(const Claim& whole) {
  try {
    return whole.contains("sha256") && whole.at("claim").at("results").is_object() &&
           whole.at("claim").at("decoder").at("dut").is_string();
  } catch (const Claim::exception&) {
    return false;
  }
}

// The first place at or below `where` at which the two differ.
std::optional<std::string> difference_at(const std::string& where, const Claim& claimed,
                                         const Claim& found) {
  if (claimed == found) return std::nullopt;
  if (!claimed.is_object() || !found.is_object()) {
    return fmt::format("{}: {} instead of {}", where, io::shown_json(found),
                       io::shown_json(claimed));
  }
  for (const auto& [key, value] : claimed.items()) {
    if (!found.contains(key)) return fmt::format("{}: less than {}", where, io::shown_json(key));
    if (auto place = difference_at(where + "/" + key, value, found.at(key))) return place;
  }
  return fmt::format("{}: more than {}", where, io::shown_json(claimed));
}

}  // namespace

io::IoResult<Claim> claim_of(const Suite& suite, const Dut& dut, const std::string& dut_text) {
  Claim files = Claim::array();
  for (const fs::path& file : files_of(dut.command)) {
    const auto mapped = io::map_file(file);
    if (!mapped) return tl::unexpected(mapped.error());
    files.push_back({{"name", io::valid_utf8(file.filename().string())},
                     {"sha256", vectors::sha256(mapped->bytes())}});
  }
  Claim waivers = Claim::object();
  for (const Waiver& waiver : dut.waivers) waivers[waiver.vector] = waiver.reason;
  Claim claims = io::written(dut.claims);
  if (suite.frames) {
    Claims own = dut.claims;
    io::Members::Json json;
    visit_renderer(io::Members(json, false), own);
    claims.update(Claim(json));
  }
  claims["error_names"] = dut.error_names;
  claims["checks_sections"] = dut.checks_sections;
  return Claim{
      {"suite",
       {{"part", suite.frames ? "frames" : "vectors"},
        {"version", suite.manifest.vectors_version},
        {"manifest_sha256", suite.manifest_sha256}}},
      {"decoder", {{"name", dut.name}, {"dut", io::valid_utf8(dut_text)}, {"files", files}}},
      {"claims", claims},
      {"waivers", waivers}};
}

void add_results(Claim& claim, const Run& run, const SystemInfo& system) {
  claim["verdict"] = verdict_text(run);
  claim["program"] = system.program;
  claim["date"] = system.date;
  Claim& results = claim["results"] = Claim::object();
  for (const VectorResult& result : run.results)
    results[result.id.text()] = status_name(result.status);
  for (const MilestoneCount& milestone : summarise(run).milestones) {
    if (milestone.vectors == 0) continue;
    claim["milestones"][milestone.name] =
        fmt::format("{} of {} pass", milestone.pass, milestone.vectors);
  }
}

io::IoResult<void> write_claim(const fs::path& file, const Claim& claim) {
  const nlohmann::ordered_json whole{{"sha256", sum_of_text(io::json_text(claim))},
                                     {"claim", claim}};
  const std::string text = io::json_text(whole, 2) + "\n";
  return io::write_file(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

io::IoResult<Claim> read_claim(const fs::path& file) {
  const auto mapped = io::map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  const auto read = io::parse_json<Claim>(mapped->bytes(), kClaimLimits);
  if (!read) return io::file_error(file, "is not a claim of hmlfc conform: " + read.error());
  const Claim& whole = *read;
  if (!is_claim(whole)) return io::file_error(file, "is not a claim of hmlfc conform");
  if (whole["sha256"] != sum_of_text(io::json_text(whole["claim"]))) {
    return io::file_error(file, "has been changed: its SHA-256 is not that of the claim");
  }
  return whole["claim"];
}

std::optional<std::string> claim_difference(const Claim& claimed, const Claim& found) {
  for (const char* key : {"suite", "decoder", "claims", "waivers", "results", "verdict"}) {
    if (!found.contains(key)) continue;
    if (auto difference = difference_at(key, claimed.value(key, Claim()), found[key])) {
      return difference;
    }
  }
  return std::nullopt;
}

}  // namespace hmlfc::conform
