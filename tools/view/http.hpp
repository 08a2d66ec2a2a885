// HTTP/1.1 as far as the page of `hmlfc view` needs it: requests without a body, and their answers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "view/exchange.hpp"

namespace hmlfc::view {

inline constexpr size_t kMaxRequestLine = 8192;  ///< bytes of a request's first line
inline constexpr size_t kMaxHead = 32768;        ///< bytes of that line and all headers
inline constexpr size_t kMaxHeaders = 100;       ///< of a request

/// A request as it came over a connection.
struct HttpRequest {
  Request request;
  bool keep = true;  ///< whether the connection may have another one
};

/// Takes the request that `received` begins with out of it; nothing where it is not whole yet.
/// Refusal, after which `received` is of no use: 400 (not HTTP/1.0 or HTTP/1.1), 413 (a body), 414
/// or 431 (more than the limits above, known as soon as that much has come).
tl::expected<std::optional<HttpRequest>, Response> take_request(std::string& received);

/// `response` as it goes over a connection, without its body for method HEAD. A length
/// only where it has an end.
std::string response_bytes(Response response, bool is_head, bool keep);

}  // namespace hmlfc::view
