// Text of others on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace hmlfc::terminal {

/// `text` without what changes a terminal or the order of letters: control characters (C0 but for
/// line ends and tabs, DEL, C1) and marks of writing direction become \u001b and the like, bytes
/// that are no UTF-8 become \u00ff and the like. JSON text stays the same JSON.
std::string shown(std::string_view text);

}  // namespace hmlfc::terminal
