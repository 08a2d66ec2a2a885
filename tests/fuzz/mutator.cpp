// The mutator of targets whose input is a stream.
#include "stream_mutation.hpp"

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  return hmlfc::fuzz::mutate_stream(data, size, max_size, seed);
}
