// The bytes of a file, for the examples. A program for large streams maps the file instead: a
// decoder reads only what its requests need.
#pragma once

#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

/// All bytes of the file `path`; none where it cannot be read.
inline std::vector<uint8_t> read_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
