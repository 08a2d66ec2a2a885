#include "view/http.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "view/guard.hpp"
#include "view/handler.hpp"

namespace hmlfc::view {

namespace {

using Refused = tl::unexpected<Response>;

// The headers that are read, in lower case; each may come once.
constexpr std::array<std::string_view, 6> kReadHeaders{
    "host", "origin", "sec-fetch-site", "connection", "content-length", "transfer-encoding"};
using HeaderValues = std::array<std::optional<std::string_view>, kReadHeaders.size()>;

Refused refuse(int status, const std::string& text) {
  Response response = refusal(status, text);
  add_safety_headers(response);
  return Refused(std::move(response));
}

Refused refuse_bytes() {
  return refuse(400, "This is no request of HTTP/1.1; only a browser should ask here");
}

bool equals_lower(std::string_view text, std::string_view lower_case) {
  return std::ranges::equal(text, lower_case, {},
                            [](char c) { return static_cast<char>(std::tolower(c & 0xff)); });
}

// Whether `text` may be a method or the name of a header.
bool is_token(std::string_view text) {
  const auto may_stand = [](char c) {
    constexpr std::string_view kOthers = "!#$%&'*+-.^_`|~";
    return std::isalnum(c & 0xff) != 0 || kOthers.find(c) != kOthers.npos;
  };
  return !text.empty() && std::ranges::all_of(text, may_stand);
}

// Takes the first line out of `text`, whose lines all end with CR LF; empty where it holds another
// control character.
std::string_view take_line(std::string_view& text) {
  const size_t end = text.find("\r\n");
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 2);
  const auto is_control = [](char c) { return std::iscntrl(c & 0xff) != 0 && c != '\t'; };
  return std::ranges::any_of(line, is_control) ? "" : line;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t";
  const size_t begin = std::min(text.find_first_not_of(kSpace), text.size());
  return text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

// Percent signs in front of anything but two hexadecimal digits stay.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    uint8_t byte = 0;
    const char* const digits = text.data() + i + 1;
    const bool escaped = text[i] == '%' && text.size() - i > 2 &&
                         std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    decoded += escaped ? static_cast<char>(byte) : text[i];
    if (escaped) i += 2;
  }
  return decoded;
}

Query read_pairs(std::string text) {
  std::ranges::replace(text, '+', ' ');
  Query query;
  for (std::string_view left = text; !left.empty();) {
    const size_t end = std::min(left.find('&'), left.size());
    const std::string_view pair = left.substr(0, end);
    const size_t equals = std::min(pair.find('='), pair.size());
    const size_t value = std::min(equals + 1, pair.size());
    query.emplace_back(percent_decoded(pair.substr(0, equals)),
                       percent_decoded(pair.substr(value)));
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return query;
}

tl::expected<HeaderValues, Response> read_headers(std::string_view text) {
  HeaderValues values;
  for (size_t count = 0; !text.empty(); ++count) {
    if (count == kMaxHeaders) {
      return refuse(431, fmt::format("A request has at most {} headers", kMaxHeaders));
    }
    const std::string_view line = take_line(text);
    const size_t colon = line.find(':');
    const std::string_view name = line.substr(0, colon);
    if (colon == line.npos || !is_token(name)) return refuse_bytes();
    const auto* const known = std::ranges::find_if(
        kReadHeaders, [name](std::string_view read) { return equals_lower(name, read); });
    if (known == kReadHeaders.end()) continue;
    auto& value = values[static_cast<size_t>(known - kReadHeaders.begin())];
    if (value) return refuse(400, fmt::format("A request has one header {}", *known));
    value = trimmed(line.substr(colon + 1));
  }
  return values;
}

// `head` is whole, without its last, empty line.
tl::expected<HttpRequest, Response> read_head(std::string_view head) {
  std::string_view line = take_line(head);
  const size_t method_end = line.find(' ');
  const size_t target_end = line.rfind(' ');
  const std::string_view method = line.substr(0, method_end);
  if (method_end == target_end || !is_token(method)) return refuse_bytes();
  const std::string_view target = line.substr(method_end + 1, target_end - method_end - 1);
  const std::string_view version = line.substr(target_end + 1);
  const bool is_old = version == "HTTP/1.0";
  if ((!is_old && version != "HTTP/1.1") || target.find(' ') != target.npos) return refuse_bytes();
  const auto values = read_headers(head);
  if (!values) return Refused(values.error());
  const auto [host, origin, site, connection, length, coding] = *values;
  if (coding || length.value_or("0") != "0") {
    return refuse(413, "A request has no body here; its address says all");
  }
  const size_t path_end = std::min(target.find('?'), target.size());
  const size_t query = std::min(path_end + 1, target.size());
  HttpRequest made;
  made.request = {std::string(method),
                  percent_decoded(target.substr(0, path_end)),
                  read_pairs(std::string(target.substr(query))),
                  std::string(host.value_or("")),
                  std::string(origin.value_or("")),
                  std::string(site.value_or(""))};
  made.keep = !is_old && !equals_lower(connection.value_or(""), "close");
  return made;
}

}  // namespace

tl::expected<std::optional<HttpRequest>, Response> take_request(std::string& received) {
  if (std::min(received.find("\r\n"), received.size()) > kMaxRequestLine) {
    return refuse(414, fmt::format("An address has at most {} bytes", kMaxRequestLine));
  }
  const size_t end = received.find("\r\n\r\n");
  if (std::min(end, received.size()) > kMaxHead) {
    return refuse(431, fmt::format("The headers of a request have at most {} bytes; delete the "
                                   "browser's cookies of this machine",
                                   kMaxHead));
  }
  if (end == received.npos) return std::nullopt;
  const std::string head = received.substr(0, end + 2);
  received.erase(0, end + 4);
  auto request = read_head(head);
  if (!request) return Refused(request.error());
  return std::move(*request);
}

std::string response_bytes(Response response, bool is_head, bool keep) {
  // The reason stands in the body.
  std::string head = fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nConnection: {}\r\n",
                                 response.status, response.status == 200 ? "OK" : "Refused",
                                 response.type, keep && !response.open ? "keep-alive" : "close");
  if (!response.open) head += fmt::format("Content-Length: {}\r\n", response.body.size());
  for (const auto& [name, value] : response.headers) {
    head += fmt::format("{}: {}\r\n", name, value);
  }
  head += "\r\n";
  if (is_head) return head;
  return std::move(response.body.insert(0, head));
}

}  // namespace hmlfc::view
