// The user's browser.
#pragma once

#include <string>

namespace hmlfc::view {

/// Asks the desktop (xdg-open) to show `address`; does nothing without a desktop. The address,
/// which holds the token, is not passed as an argument, which other users could see, but in a file
/// that only this user can read; it is removed when the object is.
class Browser {
 public:
  explicit Browser(const std::string& address);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::string file_;
};

}  // namespace hmlfc::view
