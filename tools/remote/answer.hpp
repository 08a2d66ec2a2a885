// What a server says about the range that it sends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hmlfc::remote {

/// The numbers of a header Content-Range: bytes FIRST-LAST/TOTAL, or /* (RFC 9110, section 14.4).
struct ContentRange {
  uint64_t first = 0;
  uint64_t last = 0;              ///< [first, total - 1]
  std::optional<uint64_t> total;  ///< of the file

  friend bool operator==(const ContentRange&, const ContentRange&) = default;
};

/// Reads the value of the header; nothing where it is none.
std::optional<ContentRange> parse_content_range(std::string_view text);

/// Status and headers of the last answer, after redirections.
struct AnswerHead {
  long status = 0;
  std::optional<ContentRange> range;
  std::string tag;                 ///< ETag without W/: weak and strong, it is the same version
  std::string date;                ///< Last-Modified
  std::string encoding;            ///< Content-Encoding; empty: identity
  bool is_multipart = false;       ///< by Content-Type
  std::optional<uint64_t> length;  ///< Content-Length

  /// Takes one line as libcurl gives it: a status line begins a new answer.
  void take(std::string_view line);

  /// What tells this version of a file from others; empty where the server does not say.
  const std::string& version() const { return tag.empty() ? date : tag; }
};

}  // namespace hmlfc::remote
