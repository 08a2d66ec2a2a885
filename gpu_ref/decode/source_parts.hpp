// Streams whose bytes a partial source loads, part by part.
#pragma once

#include <string>

#include "decoder/missing_ranges.hpp"
#include "decoder/request_guard.hpp"
#include "device/device_state.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// Calls `read(view)` with what it reads of `stream` loaded; a partial source may drop it
/// afterwards. `read` may be called several times, and what it made before the last call has no
/// meaning. Throws MachineError, kSource, where the source has failed.
template <class Read>
void read_part(const StreamView& stream, const Read& read) {
  if (stream.source == nullptr) return read(stream);
  const HeldBytes held(stream.source);
  if (load_by_trials(stream, [&](const StreamView& view, const MissingRanges&) { read(view); }))
    return;
  throw MachineError(FailureKind::kSource,
                     "the stream cannot be read: " + stream.source->failure());
}

}  // namespace hmlfc::gpu
