// Text inside XML and HTML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hmlfc::conform {

/// `text` with the characters that XML gives a meaning escaped; characters that XML 1.0 cannot hold
/// and bytes above 7F that are no UTF-8 become '?'.
std::string escaped(std::string_view text);

/// data:image/png;base64,...
std::string png_data_uri(const std::vector<uint8_t>& png);

}  // namespace hmlfc::conform
