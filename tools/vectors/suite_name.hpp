// Names of vectors and of their files, which a manifest or a report states.
#pragma once

#include <algorithm>
#include <compare>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "io/json_text.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// Whether `text` is a word of a-z, 0-9 and '-', of at least one character.
inline bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

enum class NameOf : uint8_t { kVector, kFile };

/// GROUP/NAME of two words (is_name); a file's name goes on after dots: "syntax/one.trace.hex".
/// As a path it lies below the folder that it is appended to, whoever wrote the text.
template <NameOf kOf>
class SuiteName {
 public:
  SuiteName() = default;

  /// Throws TextError where `text` is another.
  explicit SuiteName(std::string text) : text_(std::move(text)) {
    const std::string_view all = text_;
    const size_t slash = std::min(all.find('/'), all.size());
    std::string_view rest = all.substr(std::min(slash + 1, all.size()));
    bool good = is_name(all.substr(0, slash));
    if constexpr (kOf == NameOf::kFile) {
      for (size_t dot = rest.find('.'); dot != rest.npos; dot = rest.find('.')) {
        good = good && is_name(rest.substr(0, dot));
        rest.remove_prefix(dot + 1);
      }
    }
    if (good && is_name(rest)) return;
    throw TextError(io::shown_json(text_) + " is no name GROUP/NAME of a-z, 0-9 and -");
  }

  const std::string& text() const { return text_; }
  operator std::filesystem::path() const { return text_; }

  friend auto operator<=>(const SuiteName&, const SuiteName&) = default;

 private:
  std::string text_;
};

/// A name in JSON is its text.
template <NameOf kOf>
void visit(const io::Members& m, SuiteName<kOf>& name) {
  if (!m.reading()) return static_cast<void>(m.json() = name.text());
  name = SuiteName<kOf>(m.json().template get<std::string>());
}

using VectorId = SuiteName<NameOf::kVector>;
using FileName = SuiteName<NameOf::kFile>;

}  // namespace hmlfc::vectors
