// What an open decoder holds.
#pragma once

#include <hmlfc/decoder.hpp>

#include "fields/stream_view.hpp"
#include "samples/block_decoder.hpp"
#include "samples/key_images.hpp"
#include "samples/sparse_plane.hpp"

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
