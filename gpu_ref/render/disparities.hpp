// The disparity maps of all views on the device, for frames with geometry.
#pragma once

#include "device/buffer.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// Returns a word for each block of plane Y of each view of `stream`, views and their blocks row by
/// row: the disparity in the lower 16 bits, 2^16 more if its confidence is above 0 (GEO-1); 0 for a
/// block that has an error. Waits for the upload. Throws MachineError, kLimit, where it would take
/// more than DeviceOptions::disparity_bytes.
Buffer upload_disparities(Device::State& device, const StreamView& stream);

}  // namespace hmlfc::gpu
