// State of an open decoder.
#pragma once

#include <span>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "decoder/fast/part_loader.hpp"
#include "decoder/fast/sparse_plane.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/key_images.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

struct Decoder::State {
  State(StreamView view) : stream(std::move(view)), keys(stream), references(stream) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  StreamView stream;
  KeyImages keys;
  SparseReferences references;

  /// For the golden path, which reads reference blocks by itself.
  DecodeSources golden() const { return {stream, keys}; }
  /// For the golden path with the reference blocks that the fast path holds.
  DecodeSources golden_held() const { return {stream, keys, &references}; }
  FastSources fast(KeyRequests* requests = nullptr) const {
    return {stream, keys, references, requests};
  }

  /// Loads what decoding `parts` with their ancestors reads, where the source is partial.
  void load(std::span<const ImagePart> parts) const {
    if (stream.source == nullptr) return;
    std::vector<ImagePart> all;
    for (const ImagePart& part : parts) add_with_ancestors(stream.geometry, part, all);
    load_parts(fast(), all);
  }
};

}  // namespace hmlfc
