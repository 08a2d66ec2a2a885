// The function that libFuzzer calls.
#include <cstddef>
#include <cstdint>

#include "target.hpp"

// libFuzzer does not declare its entry point.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  hmlfc::fuzz::run({data, size});
  return 0;
}
