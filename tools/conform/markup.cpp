#include "conform/markup.hpp"

#include <openssl/evp.h>

#include <nlohmann/json.hpp>

namespace hmlfc::conform {
namespace {

// JSON's serialiser checks UTF-8; what is none becomes U+FFFD there.
std::string valid_utf8(std::string_view text) {
  using Json = nlohmann::json;
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += byte < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return out;
}

std::string png_data_uri(const std::vector<uint8_t>& png) {
  std::string text(4 * ((png.size() + 2) / 3) + 1, '\0');  // EVP_EncodeBlock ends with a zero
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), png.data(),
                                     static_cast<int>(png.size()));
  text.resize(static_cast<size_t>(length));
  return "data:image/png;base64," + text;
}

}  // namespace hmlfc::conform
