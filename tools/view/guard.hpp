// Who may ask: the page itself, in a browser of this machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "view/exchange.hpp"

namespace hmlfc::view {

/// The names under which the server answers.
struct Site {
  uint16_t port = 0;
  std::string token;  ///< first part of every path

  /// "http://127.0.0.1:8000/TOKEN/".
  std::string address() const;
};

/// 32 hexadecimal digits from the kernel's random numbers, which nobody can guess.
std::string random_token();

/// What `request` asks for: its path behind the token. Nothing where it does not come from the
/// page: a wrong token, another Host (a name that leads to this machine), or an Origin or
/// Sec-Fetch-Site of another page.
std::optional<std::string_view> asked_for(const Request& request, const Site& site);

/// Adds to every answer: nothing is loaded from elsewhere, framed, guessed or kept.
void add_safety_headers(Response& response);

}  // namespace hmlfc::view
