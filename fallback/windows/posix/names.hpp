// Names of files in UTF-8, as this project has them everywhere, and in Windows' own form.
#pragma once

#include <string>
#include <string_view>

namespace hmlfc::windows {

/// Of text that is not UTF-8, the parts that are none become U+FFFD.
std::wstring wide(std::string_view text);
std::string narrow(std::wstring_view text);

}  // namespace hmlfc::windows
