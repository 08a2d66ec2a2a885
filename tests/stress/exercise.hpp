// Every way through the decode path for one stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "width_record.hpp"

namespace hmlfc::stress {

/// What a stream did.
struct Outcome {
  Ranges ranges;
  uint64_t blocks = 0;  ///< decoded one by one
  std::string failure;  ///< empty, or what is wrong and where
};

/// Opens `file` and decodes: up to `most_blocks` blocks one by one, spread over views and planes
/// and at all stop levels, with reference images on demand and kept, each compared with
/// its plane; then all views. A stream that does not open, or whose blocks do not decode, is no
/// failure: errors are defined. A value outside its interval, a conversion that loses its value and
/// ways of decoding that differ are.
Outcome exercise(std::span<const uint8_t> file, uint64_t most_blocks);

}  // namespace hmlfc::stress
