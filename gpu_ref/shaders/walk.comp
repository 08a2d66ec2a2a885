#version 450
#extension GL_GOOGLE_include_directive : require
// What the stream says about every block of every level of every request: one invocation for a
// request and a level. No walk waits for another (BND-1). Reference images lie decoded in the reference
// area, so that a level takes one walk, with motion tiles two more (BND-2, BND-3).
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "u64.glsl"
#include "stream_words.glsl"
#include "bise.glsl"
#include "record.glsl"
#include "index_walk.glsl"
#include "cursor.glsl"
#include "block_entry.glsl"
#include "tile_head.glsl"
#include "residual_walk.glsl"
#include "reference_groups.glsl"
#include "motion_walk.glsl"
#include "reference_samples.glsl"

/// The block of a key image: the place of its plane, and its error (DEC-2).
BlockEntry key_entry(LevelShape level, PlaneShape plane, uvec2 group, uvec2 block) {
  BlockEntry entry = empty_entry(kKindKey);
  const uint base = reference_base(level, plane, group);
  entry.references[0].base = base;
  const uvec2 first = block << arguments.shape.block_log2;
  entry.status = error_of_sample(reference_sample(base, plane, int(first.x), int(first.y)));
  return entry;
}

/// The block of any other image: motion, then residual, then the reference blocks (DEC-7, MOT-10).
BlockEntry coded_entry(LevelShape level, PlaneShape plane, uvec2 at, ReferenceGroup own, uvec2 block) {
  BlockEntry entry = empty_entry(kKindCoded);
  const uint image = level.first_image + at.x * level.cols + at.y;
  const bool motion_tiles = has_feature(FEATURE_MOTION_TILES);
  const bool predictive = !kReferencePass && own.image != at;
  if (motion_tiles && predictive) {
    entry.status = walk_to_motion(level, plane, at, own, block.x, block.y, entry);
    if (entry.status != ERROR_OK) return entry;
  }
  entry.references[0].base =
      entry.count == 0u ? reference_base(level, plane, own.group) : entry.references[0].base;
  entry.status =
      walk_to_residual(image, plane, block.x, block.y, predictive && !motion_tiles, entry);
  if (arguments.damage.word[0] == 0u || kReferencePass) return entry;
  PackedReference reference = entry.references[0];
  for (uint i = 0u; i < entry.count && entry.status == ERROR_OK; ++i) {
    entry.status = touched_error(unpacked_reference(reference), plane, block.x, block.y);
    reference = entry.references[1];
  }
  return entry;
}

/// The entry of level `l` of a request. Levels that are not decoded for it have kind none.
BlockEntry entry_of_level(Request request, uint l) {
  const uint stop = level_of(request);
  if (l < stop) return empty_entry(kKindNone);
  uvec2 at = image_of(request);
  for (uint k = stop; k < l; ++k) {
    const LevelShape below = arguments.shape.levels[k];
    if (below.keyed != 0u && reference_group_of(below, at).image == at) {
      return empty_entry(kKindNone);  // EXT-5
    }
    at = ancestor(at, 1u);
  }
  const LevelShape level = arguments.shape.levels[l];
  const PlaneShape plane = arguments.shape.planes[plane_of(request)];
  const uvec2 block = block_of(request);
  const ReferenceGroup own = reference_group_of(level, at);
  if (level.keyed != 0u && own.image == at) return key_entry(level, plane, own.group, block);  // EXT-4
  return coded_entry(level, plane, at, own, block);
}

void main() {
  const uint number = invocation();
  const uint entries = entries_of_request();
  const uint q = number / entries;
  if (q >= request_count()) return;
  const Request request = arguments.requests.request[q];
  if (!is_valid(request)) return;
  const uint l = kReferencePass ? level_of(request) : number - q * entries;
  write_entry(number, entry_of_level(request, l));
}
