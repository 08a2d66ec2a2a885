// What a descriptor does to memory, by the golden model.
#pragma once

#include <span>

#include "oracle/oracle.hpp"
#include "unit/sparse_bytes.hpp"
#include "view/descriptor.hpp"

namespace hmlfc::tb {

/// The status of a descriptor.
struct ViewStatus {
  uint32_t tag = 0;
  ViewResult result = ViewResult::kOk;
  uint8_t first_error = 0;
  uint32_t block_errors = 0;
  uint32_t write_errors = 0;

  std::array<uint32_t, kViewStatusBytes / 4> words() const {
    return {tag, static_cast<uint32_t>(result) | uint32_t{first_error} << 8, block_errors,
            write_errors};
  }
  static ViewStatus of_words(std::span<const uint32_t, 4> words) {
    return {words[0], static_cast<ViewResult>(words[1] & 255), static_cast<uint8_t>(words[1] >> 8),
            words[2], words[3]};
  }
  friend bool operator==(const ViewStatus&, const ViewStatus&) = default;
};

/// Whether a unit with blocks of `block_size` takes the descriptor.
bool is_accepted(const Descriptor& descriptor, unsigned block_size);

/// Bytes of its error bitmap.
uint64_t bitmap_bytes(const Descriptor& descriptor, unsigned block_size);

/// Writes pixels and bitmap into `memory`, as the unit must, and returns the status that it must
/// write. The descriptor's rectangle ends within the plane, or with a whole block outside.
ViewStatus write_expected(Oracle& oracle, const Descriptor& descriptor, unsigned block_size,
                          SparseBytes& memory);

}  // namespace hmlfc::tb
