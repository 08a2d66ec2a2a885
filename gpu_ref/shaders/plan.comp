#version 450
#extension GL_GOOGLE_include_directive : require
// What a frame decodes, from what count.comp has counted, and the sizes of the dispatches that do it:
// one invocation.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"

/// Vulkan allows every dispatch this many workgroups in a dimension.
const uint kMaxWorkgroups = 65535u;

void write_dispatch(uint at, uint invocations) {
  const uint workgroups = (invocations + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
  const uint columns = clamp(workgroups, 1u, kMaxWorkgroups);
  frame().dispatches.word[at] = columns;
  frame().dispatches.word[at + 1u] = (workgroups + columns - 1u) / columns;
  frame().dispatches.word[at + 2u] = 1u;
}

void main() {
  if (invocation() != 0u) return;
  const uint used = frame().counters.word[kCountUsedPages];
  const uint kept = frame().kept_pages;
  const bool flush = used > kept || frame().counters.word[kCountMissingPages] > kept - used;
  const uint decoded = frame().counters.word[flush ? kCountNeeded : kCountMissing];
  const uint first_page = flush ? 0u : used;
  const uint pages =
      first_page + frame().counters.word[flush ? kCountNeededPages : kCountMissingPages];
  const bool room = decoded <= frame().capacity && pages <= frame().pool_pages;
  frame().counters.word[kCountDecoded] = decoded;
  frame().counters.word[kCountPages] = pages;
  frame().counters.word[kCountNextPage] = first_page;
  frame().counters.word[kCountMode] = !room ? kModeNoRoom : flush ? kModeFlush : kModeAdd;
  if (room) frame().counters.word[kCountUsedPages] = pages;
  const uint count = room ? decoded : 0u;
  write_dispatch(kDispatchWalk, count * (arguments.shape.top + 1u));
  write_dispatch(kDispatchSamples, count << (2u * arguments.shape.block_log2 - 1u));
  write_dispatch(kDispatchErrors, count);
}
