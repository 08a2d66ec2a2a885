// Requests of the decode unit's bench, answered by the GPU decoder.
#pragma once

#include <span>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

#include "oracle/level_record.hpp"
#include "oracle/request.hpp"

namespace hmlfc::gpu {

/// The answers to `requests`, in their order, of a stream with blocks of `block_size`.
Outcome<std::vector<tb::Answer>> gpu_answers(GpuDecoder& decoder, unsigned block_size,
                                             std::span<const tb::Request> requests);

/// What the debug variant says about a request of planes 0 to 2: a record for each level, as the
/// decode unit's trace port gives them. The last
/// record has the error, where there is one.
struct GpuTrace {
  uint8_t status = 0;
  std::vector<tb::LevelRecord> levels;
};

/// The traces of `requests`, none of them for RGB. The place of a level's image is not filled in.
Outcome<std::vector<GpuTrace>> gpu_traces(GpuDecoder& decoder,
                                          std::span<const tb::Request> requests);

}  // namespace hmlfc::gpu
