// Which buffers each kernel reads and writes: the table that the check of barriers uses.
#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"
#include "hazards.hpp"
#include "kernels.hpp"

namespace hmlfc::gpu {

/// The buffers that `kernel` uses in `variant`. `frame` is what arguments.frame points to, for the
/// kernels of a frame, else null. tests/gpu/kernel_accesses.py compares the table with the SPIR-V.
std::vector<BufferAccess> accesses_of(const std::string& kernel, const Variant& variant,
                                      const Arguments& arguments, const FrameArguments* frame);

}  // namespace hmlfc::gpu
