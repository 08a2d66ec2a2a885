// What users should know of the files that were read, although nothing failed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hmlfc::io {

/// Remarks on what reading changed, reduced or left out: one a kind, with the first file that it is
/// true of and the number of others.
class Notes {
 public:
  /// Remarks `what`, the same text for all files of a kind, on `file`; twice counts once.
  void add(const std::filesystem::path& file, std::string what);

  /// Adds those of `later`, other files. Returns those of a kind that was not here before.
  Notes add(const Notes& later);

  /// One a kind, in the order in which the kinds came: "FILE: what", "FILE and 80 more: what".
  std::vector<std::string> lines() const;

 private:
  struct Kind {
    std::string what;
    std::filesystem::path first;
    size_t others = 0;
  };

  Kind* find(const std::string& what);

  std::vector<Kind> kinds_;
};

}  // namespace hmlfc::io
