#version 450
#extension GL_GOOGLE_include_directive : require
// From entries to samples (DEC-3): one invocation for up to 8 samples of a request, from its
// first level down to its stop level. Neighbouring invocations write neighbouring words.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "stream_words.glsl"
#include "block_lanes.glsl"
#include "bise.glsl"
#include "block_entry.glsl"
#include "reconstruct.glsl"
#include "reference_samples.glsl"
#include "interpolation.glsl"

/// The debug variant writes every stage of every level.
layout(constant_id = 2) const bool kStages = false;

const uint kStageResidual = 0u;
const uint kStageReference = 1u;
const uint kStagePrediction = 2u;
const uint kStageSample = 3u;

/// Where the invocation's samples are: from position `first` on in the block of entry `number`, whose
/// first sample is `corner` in the plane.
struct Place {
  uint number;
  uint first;
  ivec2 corner;
};

/// Writes the pairs of the invocation.
void write_stage(Place place, uint stage, uvec4 pairs) {
  if (!kStages) return;
  const uint at = ((place.number * 4u + stage) << words_of_block_log2()) + (place.first >> 1);
  for (uint k = 0u; k < 1u << words_of_lane_log2(); ++k) arguments.stages.word[at + k] = pairs[k];
}

/// The pairs of one level on top of its parent's `pairs` (DEC-3).
uvec4 add_level(KeptEntry entry, PlaneShape plane, bool keyed, Place place, uvec4 pairs) {
  if (reference_count(entry) != 0u) {
    const uvec4 references = reference_pairs(entry, plane, place.corner, place.first);
    write_stage(place, kStageReference, references);
    if (keyed) pairs = uvec4(0u);  // EXT-5
    pairs = motion_prediction(pairs, is_negative(entry), references, plane);
  }
  write_stage(place, kStagePrediction, pairs);
  if (!has_residual(entry)) return pairs;
  const uvec4 residuals = residual_pairs(entry, plane, place.first);
  write_stage(place, kStageResidual, residuals);
  return add_residuals(pairs, residuals, plane);
}

/// Pairs of a key image's plane (DEC-2). What lies outside the plane has no meaning, and is read inside.
uvec4 key_pairs(KeptEntry entry, PlaneShape plane, Place place) {
  const uint base = base_of(entry);
  uvec4 pairs = uvec4(0u);
  [[dont_unroll]] for (uint i = place.first; i < place.first + SAMPLES_OF_LANE; i += 2u) {
    const ivec2 at = place.corner + ivec2(place_in_block(i));
    const ivec2 cols = min(ivec2(at.x, at.x + 1), int(plane.width) - 1);
    const int row = min(at.y, int(plane.height) - 1);
    pairs = uvec4(pairs.yzw, sample_pair(ivec2(reference_sample(base, plane, cols.x, row),
                                               reference_sample(base, plane, cols.y, row))));
  }
  return pairs;
}

/// The pairs of a request from position `first` on, or 0 with the error of its first level that has
/// one (CNV-7).
uvec4 decode(Request request, uint q, uint first, out uint status) {
  const PlaneShape plane = arguments.shape.planes[plane_of(request)];
  const ivec2 corner = ivec2(block_of(request) << arguments.shape.block_log2);
  const uint entries = entries_of_request();
  uvec4 pairs = uvec4(0u);  // DEC-6
  status = ERROR_OK;
  for (int l = int(arguments.shape.top); l >= int(level_of(request)); --l) {
    const Place place = Place(q * entries + uint(l), first, corner);
    const KeptEntry entry = read_entry(place.number);
    if (kind_of(entry) == kKindNone) continue;
    status = status_of(entry);
    if (status != ERROR_OK) return uvec4(0u);
    if (kind_of(entry) == kKindKey) {
      pairs = key_pairs(entry, plane, place);
    } else {
      pairs = add_level(entry, plane, arguments.shape.levels[l].keyed != 0u, place, pairs);
    }
    write_stage(place, kStageSample, pairs);
  }
  return pairs;
}

/// The first needed block that does not decode (NED-2). It is in the pool like the others: the next
/// frame must not find it.
void note_error(uint q) {
  atomicMin(frame().counters.word[kCountFirstError], frame().slots.word[2u * q + 1u]);
  atomicMax(frame().used_pages.word[0], kUsedNothingHeld);
}

void main() {
  const uint number = invocation();
  const uint q = number >> lanes_of_block_log2();
  if (q >= request_count()) return;
  const uint lane = low_bits(number, lanes_of_block_log2());
  const Request request = arguments.requests.request[q];
  uint status = ERROR_BAD_REQUEST;
  uvec4 pairs = uvec4(0u);
  if (is_valid(request)) pairs = decode(request, q, lane * SAMPLES_OF_LANE, status);
  // In the pool a block with an error holds that error instead of samples: no frame is drawn from it.
  if (kCounted && status != ERROR_OK) pairs = uvec4(status);
  const uint first_word = word_of_request(q, lane << 2);
  const uint words = 1u << words_of_lane_log2();
  for (uint k = 0u; k < words; ++k) {
    write_samples(first_word + k, pairs.x);
    pairs = pairs.yzwx;
  }
  if (lane != 0u) return;
  if (kCounted) {
    if (status != ERROR_OK) note_error(q);
  } else {
    arguments.statuses.word[q] = status;
  }
}
