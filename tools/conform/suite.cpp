#include "conform/suite.hpp"

#include <fnmatch.h>

#include <algorithm>

#include <fmt/format.h>

#include "io/mapped_file.hpp"
#include "vectors/sha256.hpp"

namespace hmlfc::conform {

io::IoResult<Suite> open_suite(const std::filesystem::path& folder) {
  auto manifest = vectors::read_manifest(folder);
  if (!manifest) return tl::unexpected(manifest.error());
  const auto file = io::MappedFile::open(folder / "manifest.json");
  if (!file) return tl::unexpected(file.error());
  return Suite{folder, std::move(*manifest), vectors::sha256(file->bytes())};
}

bool matches(const vectors::Vector& vector, const std::string& pattern) {
  const auto fits = [&](const std::string& text) {
    return ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
  };
  return fits(vector.id) || std::ranges::any_of(vector.clauses, fits) ||
         std::ranges::any_of(vector.flags, fits);
}

std::string why_left_out(const Selection& selection, const vectors::Vector& vector, size_t index) {
  const auto& filters = selection.filters;
  const auto fits = [&](const std::string& pattern) { return matches(vector, pattern); };
  if (!filters.empty() && std::ranges::none_of(filters, fits)) return "left out by --filter";
  if (index % selection.shards + 1 != selection.shard) {
    return fmt::format("in another shard than {}/{}", selection.shard, selection.shards);
  }
  return {};
}

}  // namespace hmlfc::conform
