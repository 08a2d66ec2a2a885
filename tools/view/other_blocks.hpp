// What the page shows of a decoder under test.
#pragma once

#include "view/exchange.hpp"
#include "view/open_stream.hpp"
#include "view/other_decoder.hpp"

namespace hmlfc::view {

/// Answers queries as Blocks does, about the decoder under test, of which whole views are known
/// with all levels alone. All functions may be called at the same time. Failures: those of the
/// query, a corrupt stream, a decoder that does not answer (kCorrupt).
class OtherBlocks {
 public:
  /// Both must outlive it.
  OtherBlocks(OpenStream& stream, OtherDecoder& other) : stream_(stream), other_(other) {}

  /// Its view, as other_picture() has it.
  Response picture(const Query& query, bool difference);

  /// {"worst": [...]}: of each block of the plane, row by row, the largest difference of a sample
  /// in RGB.
  Response blocks(const Query& query);

  /// {"name", "stages": [{"level", "image": {row, col}, "stage", "values" (rows)}], "pixels": the
  /// view's pixels of the block [[[r, g, b]]] or null, "golden": the right ones}: stages of the
  /// block itself, not of reference blocks, as far as it gives them; else its pixels.
  Response block(const Query& query);

 private:
  OpenStream& stream_;
  OtherDecoder& other_;
};

}  // namespace hmlfc::view
