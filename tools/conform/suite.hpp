// A suite of vectors on disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vectors/manifest.hpp"

namespace hmlfc::conform {

/// A manifest and where its files are.
struct Suite {
  std::filesystem::path folder;
  vectors::Manifest manifest;
  std::string manifest_sha256;  ///< of manifest.json, tells suites apart
};

/// Errors: those of vectors::read_manifest().
io::IoResult<Suite> open_suite(const std::filesystem::path& folder);

/// Which vectors to run, of those that a decoder claims.
struct Selection {
  std::vector<std::string> filters;  ///< any of them must match; none: all do
  unsigned shard = 1;                ///< [1, shards]
  unsigned shards = 1;

  bool all() const { return filters.empty() && shards == 1; }
};

/// Whether a pattern with * and ? matches the vector's id, one of its clauses or one of its flags.
bool matches(const vectors::Vector& vector, const std::string& pattern);

/// Why vector number `index` of the manifest is left out; empty where it is not. Shard I of N has
/// the vectors whose number is I - 1 modulo N.
std::string why_left_out(const Selection& selection, const vectors::Vector& vector, size_t index);

}  // namespace hmlfc::conform
