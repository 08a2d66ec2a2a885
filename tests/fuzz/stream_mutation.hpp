// libFuzzer's mutations of streams.
#pragma once

#include <cstddef>
#include <cstdint>

/// libFuzzer's own mutation: changes `size` bytes at `data` and returns how many there are then.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

/// The mutation that libFuzzer asks for: of `size` bytes at `data`, with room for `max_size`.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed);

namespace hmlfc::fuzz {

/// Does what LLVMFuzzerCustomMutator does, for a stream.
size_t mutate_stream(uint8_t* data, size_t size, size_t max_size, unsigned seed);

}  // namespace hmlfc::fuzz
