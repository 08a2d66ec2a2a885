// What libFuzzer calls.
#include <cstddef>
#include <cstdint>

#include "target.hpp"

// libFuzzer's names, which it declares nowhere.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  hmlfc::fuzz::run({data, size});
  return 0;
}
