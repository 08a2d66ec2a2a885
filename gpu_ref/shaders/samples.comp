#version 450
#extension GL_GOOGLE_include_directive : require
// From entries to samples (DEC-3): one invocation for two samples of a request, from its first
// level down to its stop level. Neighbouring invocations write neighbouring words.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "stream_words.glsl"
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

/// Where in the block the invocation's samples are: positions i and i + 1 of entry `number`.
struct Place {
  uint number;
  uint i;
  int x, y;  // of the first, in the plane
};

void write_stage(Place place, uint stage, ivec2 samples) {
  if (!kStages) return;
  const uint words_log2 = 2u * arguments.shape.block_log2 - 1u;
  const uint at = ((place.number * 4u + stage) << words_log2) + (place.i >> 1);
  arguments.stages.word[at] = sample_pair(samples);
}

/// The samples of one level on top of its parent's `samples` (DEC-3).
ivec2 add_level(BlockEntry entry, PlaneShape plane, bool keyed, Place place, ivec2 samples) {
  if (entry.count != 0u) {
    const ivec2 reference = ivec2(reference_value(entry, plane, place.x, place.y),
                                  reference_value(entry, plane, place.x + 1, place.y));
    const ivec2 parent = keyed ? ivec2(0) : samples;  // EXT-5
    samples.x = motion_prediction(parent.x, entry.negative, reference.x, plane);
    samples.y = motion_prediction(parent.y, entry.negative, reference.y, plane);
    write_stage(place, kStageReference, reference);
  }
  write_stage(place, kStagePrediction, samples);
  if (entry.residual) {
    const ivec2 residual = ivec2(residual_value(entry, plane, place.i),
                                 residual_value(entry, plane, place.i + 1u));
    samples.x = add_residual(samples.x, residual.x, plane);
    samples.y = add_residual(samples.y, residual.y, plane);
    write_stage(place, kStageResidual, residual);
  }
  return samples;
}

/// Two samples of a key image's plane (DEC-2).
ivec2 key_samples(BlockEntry entry, PlaneShape plane, Place place) {
  const uint base = entry.references[0].base;
  return ivec2(ref(base, plane, place.x, place.y), ref(base, plane, place.x + 1, place.y));
}

/// The samples of a request, or 0 with the error of its first level that has one (CNV-7).
ivec2 decode(Request request, uint q, uint i, out uint status) {
  const uint log2 = arguments.shape.block_log2;
  const PlaneShape plane = arguments.shape.planes[plane_of(request)];
  const uvec2 first = block_of(request) << log2;
  const uint entries = entries_of_request();
  ivec2 samples = ivec2(0);  // DEC-6
  status = ERROR_OK;
  for (int l = int(arguments.shape.top); l >= int(level_of(request)); --l) {
    const Place place = Place(q * entries + uint(l), i, int(first.x + (i & low_bits(log2))),
                              int(first.y + (i >> log2)));
    const BlockEntry entry = read_entry(place.number);
    if (entry.kind == kKindNone) continue;
    status = entry.status;
    if (status != ERROR_OK) return ivec2(0);
    const bool keyed = arguments.shape.levels[l].keyed != 0u;
    samples = entry.kind == kKindKey ? key_samples(entry, plane, place)
                                     : add_level(entry, plane, keyed, place, samples);
    write_stage(place, kStageSample, samples);
  }
  return samples;
}

/// The first needed block that does not decode (NED-2). It is in the pool like the others: the next
/// frame must not find it.
void note_error(uint q) {
  atomicMin(frame().counters.word[kCountFirstError], frame().slots.word[2u * q + 1u]);
  atomicMax(frame().used_pages.word[0], kUsedNothingHeld);
}

void main() {
  const uint words_log2 = 2u * arguments.shape.block_log2 - 1u;
  const uint number = invocation();
  const uint q = number >> words_log2;
  if (q >= request_count()) return;
  const uint word = number & low_bits(words_log2);
  const Request request = arguments.requests.request[q];
  uint status = ERROR_BAD_REQUEST;
  ivec2 samples = ivec2(0);
  if (is_valid(request)) samples = decode(request, q, 2u * word, status);
  write_samples(q, word, sample_pair(samples), status);
  if (word != 0u) return;
  if (kCounted) {
    if (status != ERROR_OK) note_error(q);
  } else {
    arguments.statuses.word[q] = status;
  }
}
