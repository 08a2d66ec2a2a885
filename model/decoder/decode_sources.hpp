// Where a decoder finds what it does not read block by block.
#pragma once

#include "decoder/fast/sparse_plane.hpp"
#include "decoder/key_images.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

struct DecodeSources {
  const StreamView& stream;
  const KeyImages& keys;
  const SparseReferences* references = nullptr;  ///< null: reference blocks are read on demand
};

}  // namespace hmlfc
