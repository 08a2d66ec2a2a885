// What a frame decodes, and the sizes of the dispatches that do it. The workgroups of mark.comp count
// the blocks that the frame needs; the last of them that is done decides, or plan.comp after them.

/// plan.comp decides: WGSL orders no memory between workgroups.
layout(constant_id = 7) const bool kPlanApart = false;

/// The counters kCountNeeded to kCountMissingPages of this workgroup.
shared uint marked[4];

void begin_marking() {
  if (gl_LocalInvocationIndex < 4u) marked[gl_LocalInvocationIndex] = 0u;
  barrier();
}

/// Counts that word `at` of the needed bits had the bits `before` and has those of `mask` as well now.
void count_marked(uint at, uint before, uint mask) {
  const uint needed = mask & ~before;
  if (needed == 0u) return;
  atomicAdd(marked[kCountNeeded], uint(bitCount(needed)));
  if (before == 0u) atomicAdd(marked[kCountNeededPages], 1u);
  const uint held = frame().held.word[at];
  if ((needed & ~held) == 0u) return;
  atomicAdd(marked[kCountMissing], uint(bitCount(needed & ~held)));
  if (before == 0u && held == 0u) atomicAdd(marked[kCountMissingPages], 1u);
}

/// Vulkan allows every dispatch this many workgroups in a dimension.
const uint kMaxWorkgroups = 65535u;

void write_dispatch(uint at, uint invocations) {
  const uint workgroups = (invocations + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
  const uint columns = clamp(workgroups, 1u, kMaxWorkgroups);
  frame().dispatches.word[at] = columns;
  frame().dispatches.word[at + 1u] = (workgroups + columns - 1u) / columns;
  frame().dispatches.word[at + 2u] = 1u;
}

uint total(uint counter) {
  return atomicLoad(frame().counters.word[counter], gl_ScopeDevice, gl_StorageSemanticsBuffer,
                    gl_SemanticsRelaxed);
}

void plan_frame() {
  const uint used = frame().used_pages.word[0];
  const uint kept = frame().kept_pages;
  const bool forget = frame().forget != 0u || frame().used_pages.word[1] != frame().stop_level;
  const bool flush = forget || used > kept || total(kCountMissingPages) > kept - used;
  const uint decoded = total(flush ? kCountNeeded : kCountMissing);
  const uint first_page = flush ? 0u : used;
  const uint pages = first_page + total(flush ? kCountNeededPages : kCountMissingPages);
  const bool room = decoded <= frame().capacity && pages <= frame().pool_pages;
  frame().counters.word[kCountDecoded] = decoded;
  frame().counters.word[kCountPages] = pages;
  frame().counters.word[kCountNextPage] = first_page;
  frame().counters.word[kCountMode] = !room ? kModeNoRoom : flush ? kModeFlush : kModeAdd;
  if (room || forget) frame().used_pages.word[0] = room ? pages : kUsedNothingHeld;
  frame().used_pages.word[1] = frame().stop_level;
  const uint count = room ? decoded : 0u;
  write_dispatch(kDispatchWalk, count * (arguments.shape.top + 1u));
  write_dispatch(kDispatchSamples, count << lanes_of_block_log2());
}

/// Adds what the workgroup has counted; the last workgroup plans the frame.
void end_marking() {
  barrier();
  if (gl_LocalInvocationIndex != 0u) return;
  for (uint i = 0u; i < 4u; ++i) {
    if (marked[i] != 0u) atomicAdd(frame().counters.word[i], marked[i]);
  }
  if (kPlanApart) return;
  memoryBarrierBuffer();
  const uint workgroups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
  if (atomicAdd(frame().counters.word[kCountWorkgroups], 1u) + 1u != workgroups) return;
  memoryBarrierBuffer();
  plan_frame();
}
