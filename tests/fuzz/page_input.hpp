// The input of target view: a request and the stream that it is about.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "target.hpp"

namespace hmlfc::fuzz {

/// Two bytes, the length of the request, then the request, then the stream.
struct PageInput {
  std::span<const uint8_t> request;
  std::span<const uint8_t> stream;

  /// Any bytes are an input: what is missing is empty.
  static PageInput of(std::span<const uint8_t> input) {
    InputReader reader(input);
    const size_t low = reader.byte();
    const size_t size = low + 256 * size_t{reader.byte()};
    const auto rest = reader.rest();
    const size_t bytes = std::min(size, rest.size());
    return {rest.first(bytes), rest.subspan(bytes)};
  }

  /// `request` has at most 65535 bytes.
  Bytes bytes() const {
    Bytes all{static_cast<uint8_t>(request.size() & 255),
              static_cast<uint8_t>(request.size() >> 8)};
    all.insert(all.end(), request.begin(), request.end());
    all.insert(all.end(), stream.begin(), stream.end());
    return all;
  }
};

}  // namespace hmlfc::fuzz
