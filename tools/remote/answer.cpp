#include "remote/answer.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace hmlfc::remote {
namespace {

// Takes a decimal number and the text `after` it from the front of `text`.
std::optional<uint64_t> take_number(std::string_view& text, std::string_view after) {
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  if (!text.starts_with(after)) return std::nullopt;
  text.remove_prefix(after.size());
  return number;
}

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

// In any case; `name` is in lower case.
bool is_name(std::string_view text, std::string_view name) {
  return std::ranges::equal(
      text, name, [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

std::optional<uint64_t> number_of(std::string_view text) {
  const auto number = take_number(text, "");
  return text.empty() ? number : std::nullopt;
}

}  // namespace

std::optional<ContentRange> parse_content_range(std::string_view text) {
  constexpr std::string_view kUnit = "bytes ";
  if (!is_name(text.substr(0, kUnit.size()), kUnit)) return std::nullopt;
  text.remove_prefix(kUnit.size());
  const auto first = take_number(text, "-");
  const auto last = first ? take_number(text, "/") : std::nullopt;
  if (!last || *first > *last) return std::nullopt;
  if (text == "*") return ContentRange{*first, *last, std::nullopt};
  const auto total = number_of(text);
  if (!total || *last >= *total) return std::nullopt;
  return ContentRange{*first, *last, total};
}

void AnswerHead::take(std::string_view line) {
  if (line.starts_with("HTTP/")) {
    *this = {};
    line.remove_prefix(std::min(line.find(' '), line.size()));
    line = trimmed(line);
    status = static_cast<long>(take_number(line, "").value_or(0));
    return;
  }
  const size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (is_name(name, "content-range")) range = parse_content_range(value);
  if (is_name(name, "etag")) tag = value.substr(value.starts_with("W/") ? 2 : 0);
  if (is_name(name, "last-modified")) date = value;
  if (is_name(name, "content-encoding") && !is_name(value, "identity")) encoding = value;
  if (is_name(name, "content-type")) is_multipart = is_name(value.substr(0, 10), "multipart/");
  if (is_name(name, "content-length")) length = number_of(value);
}

}  // namespace hmlfc::remote
