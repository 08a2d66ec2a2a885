#version 450
#extension GL_GOOGLE_include_directive : require
// The sizes of the dispatches that decode what compact.comp has counted: one invocation. Where there
// is no room for it nothing is decoded, and the host makes room.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"

/// Vulkan allows every dispatch this many workgroups in a dimension.
const uint kMaxGroups = 65535u;

void write_dispatch(uint at, uint invocations) {
  const uint groups = (invocations + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
  const uint columns = clamp(groups, 1u, kMaxGroups);
  frame().counters.word[at] = columns;
  frame().counters.word[at + 1u] = (groups + columns - 1u) / columns;
  frame().counters.word[at + 2u] = 1u;
}

void main() {
  if (invocation() != 0u) return;
  const uint needed = frame().counters.word[kCountNeeded];
  const uint count = needed <= frame().capacity ? needed : 0u;
  write_dispatch(kCountWalk, count * (arguments.shape.top + 1u));
  write_dispatch(kCountSamples, count << (2u * arguments.shape.block_log2 - 1u));
  write_dispatch(kCountErrors, count);
}
