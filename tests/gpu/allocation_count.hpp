// Counts the allocations of a test program.
#pragma once

#include <cstdint>

namespace hmlfc::test {

/// Calls of operator new so far, in all threads.
uint64_t allocation_count();

}  // namespace hmlfc::test
