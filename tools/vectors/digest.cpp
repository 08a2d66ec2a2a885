#include "vectors/digest.hpp"

#include <array>
#include <new>

#include <fmt/ranges.h>
#include <openssl/evp.h>

#include "bits/little_endian.hpp"

namespace hmlfc::vectors {

std::string sha256(std::span<const uint8_t> bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::bad_alloc();
  }
  return fmt::format("{:02x}", fmt::join(std::span(digest).first(size), ""));
}

std::vector<uint8_t> picture_bytes(const RgbImage& image) {
  std::vector<uint8_t> bytes;
  bytes.reserve(image.samples.size() * (image.depth > 8 ? 2 : 1));
  for (const uint16_t sample : image.samples) {
    if (image.depth > 8) {
      append_le(bytes, sample);
    } else {
      bytes.push_back(static_cast<uint8_t>(sample));
    }
  }
  return bytes;
}

}  // namespace hmlfc::vectors
