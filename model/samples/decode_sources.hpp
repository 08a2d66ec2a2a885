// Where a decoder finds what it does not read block by block.
#pragma once

#include "fields/stream_view.hpp"
#include "samples/key_images.hpp"
#include "samples/sparse_plane.hpp"

namespace hmlfc {

struct DecodeSources {
  const StreamView& stream;
  const KeyImages& keys;
  const SparseReferences* references = nullptr;  ///< null: reference blocks are read on demand
};

}  // namespace hmlfc
