// What an open decoder holds.
#pragma once

#include <hmlfc/decoder.hpp>

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

  /// Sources that read reference blocks on demand.
  DecodeSources on_demand() const { return {stream, keys, nullptr}; }
  /// Sources that keep decoded reference images.
  DecodeSources sparse() const { return {stream, keys, &references}; }
};

}  // namespace hmlfc
