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

/// Leaves pair k of the invocation.
void write_stage(Place place, uint stage, uint k, uint pair) {
  if (!kStages) return;
  if (k >> words_of_lane_log2() != 0u) return;
  const uint at = ((place.number * 4u + stage) << words_of_block_log2()) + (place.first >> 1) + k;
  arguments.stages.word[at] = pair;
}

/// Pair k of one level on top of its parent's `samples` (DEC-3).
ivec2 add_level(BlockEntry entry, PlaneShape plane, bool keyed, Place place, uint k, uint references,
                uint residuals, ivec2 samples) {
  if (entry.count != 0u) {
    const ivec2 parent = keyed ? ivec2(0) : samples;  // EXT-5
    samples = motion_prediction(parent, entry.negative, samples_of_pair(references), plane);
    write_stage(place, kStageReference, k, references);
  }
  write_stage(place, kStagePrediction, k, sample_pair(samples));
  if (!entry.residual) return samples;
  write_stage(place, kStageResidual, k, residuals);
  return add_residual(samples, samples_of_pair(residuals), plane);
}

/// Pair k of a key image's plane (DEC-2). What lies outside the plane has no meaning, and is read inside.
ivec2 key_samples(BlockEntry entry, PlaneShape plane, Place place, uint k) {
  const uint base = entry.references[0].base;
  const ivec2 at = place.corner + ivec2(place_in_block(place.first + 2u * k));
  const ivec2 cols = min(ivec2(at.x, at.x + 1), int(plane.width) - 1);
  const int row = min(at.y, int(plane.height) - 1);
  return ivec2(reference_sample(base, plane, cols.x, row),
               reference_sample(base, plane, cols.y, row));
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
    const BlockEntry entry = read_entry(place.number);
    if (entry.kind == kKindNone) continue;
    status = entry.status;
    if (status != ERROR_OK) return uvec4(0u);
    const bool keyed = arguments.shape.levels[l].keyed != 0u;
    uvec4 residuals = uvec4(0u);
    if (entry.residual) residuals = residual_pairs(entry, plane, first);
    uvec4 references = uvec4(0u);
    if (entry.count != 0u) references = reference_pairs(entry, plane, corner, first);
    [[dont_unroll]] for (uint k = 0u; k < SAMPLES_OF_LANE / 2u; ++k) {
      const ivec2 samples =
          entry.kind == kKindKey
              ? key_samples(entry, plane, place, k)
              : add_level(entry, plane, keyed, place, k, references.x, residuals.x,
                          samples_of_pair(pairs.x));
      write_stage(place, kStageSample, k, sample_pair(samples));
      pairs = uvec4(pairs.yzw, sample_pair(samples));
      references = references.yzwx;
      residuals = residuals.yzwx;
    }
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
  // In the pool a block with an error has that in place of samples: no frame is drawn from it.
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
