// A stream as an annotated dump: every field with its address, value and clause.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace hmlfc::vectors {

/// One line for each field of `file`, in the order of addresses: byte and bit, the bytes that hold
/// it, name, value and clause. Bytes that no field stands in (codestreams, block values) are shown
/// as such. Of a damaged stream: as far as it can be read, and the error.
std::string annotated_dump(std::span<const uint8_t> file);

}  // namespace hmlfc::vectors
