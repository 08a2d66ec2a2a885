// What a check of the decode path throws.
#pragma once

#include <stdexcept>
#include <string>

namespace hmlfc::vectors {

/// What is wrong with a vector.
class Mismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws `what` unless the condition holds.
inline void demand(bool condition, const std::string& what) {
  if (!condition) throw Mismatch(what);
}

}  // namespace hmlfc::vectors
