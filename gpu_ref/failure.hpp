// What went wrong with the machine, not with the stream.
#pragma once

#include <string>

#include <tl/expected.hpp>

namespace hmlfc::gpu {

/// A missing driver or device, no memory, a lost device, or a stream beyond what the device holds.
struct Failure {
  std::string message;  ///< one line: what is missing, and what to do
};

template <class T>
using Outcome = tl::expected<T, Failure>;

}  // namespace hmlfc::gpu
