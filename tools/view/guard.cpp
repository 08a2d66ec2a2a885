#include "view/guard.hpp"

#include <sys/random.h>

#include <array>
#include <system_error>

#include <fmt/format.h>

namespace hmlfc::view {

namespace {

// Whether both are equal, in a time that depends on their lengths alone.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned>(a[i] ^ b[i]);
  }
  return difference == 0;
}

}  // namespace

std::string Site::address() const { return fmt::format("http://127.0.0.1:{}/{}/", port, token); }

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::system_error(errno, std::generic_category(), "getrandom");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::optional<std::string_view> asked_for(const Request& request, const Site& site) {
  constexpr int kUnsaid = 80;  // browsers leave out the port of http
  const auto is_host = [&](const std::string& name) {
    return request.host == fmt::format("{}:{}", name, site.port) ||
           (site.port == kUnsaid && request.host == name);
  };
  if (!is_host("127.0.0.1") && !is_host("localhost")) return std::nullopt;
  if (!request.origin.empty() && request.origin != "http://" + request.host) return std::nullopt;
  if (request.site == "cross-site" || request.site == "same-site") return std::nullopt;
  std::string_view path = request.path;
  if (path.empty() || path.front() != '/') return std::nullopt;
  path.remove_prefix(1);
  const size_t slash = path.find('/');
  if (slash == path.npos || !same_secret(path.substr(0, slash), site.token)) return std::nullopt;
  return path.substr(slash + 1);
}

void add_safety_headers(Response& response) {
  const std::pair<const char*, const char*> headers[] = {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
       "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cache-Control", "no-store"}};
  for (const auto& [name, value] : headers) response.headers.emplace_back(name, value);
}

}  // namespace hmlfc::view
