// What a server says about the range that it sends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hmlfc::remote {

/// The numbers of a header Content-Range: bytes FIRST-LAST/TOTAL.
struct ContentRange {
  uint64_t first = 0;
  uint64_t last = 0;   ///< [first, total - 1]
  uint64_t total = 0;  ///< of the file

  friend bool operator==(const ContentRange&, const ContentRange&) = default;
};

/// Reads the value of the header; nothing where it is none, or without a total.
std::optional<ContentRange> parse_content_range(std::string_view text);

/// Status and headers of the last answer, after redirections.
struct AnswerHead {
  long status = 0;
  std::optional<ContentRange> range;
  std::string tag;   ///< ETag as it is sent
  std::string date;  ///< Last-Modified

  /// Takes one line as libcurl gives it: a status line begins a new answer.
  void take(std::string_view line);

  /// What tells this version of a file from others; empty where the server does not say.
  const std::string& version() const { return tag.empty() ? date : tag; }
};

}  // namespace hmlfc::remote
