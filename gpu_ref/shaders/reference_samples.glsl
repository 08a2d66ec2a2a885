// The reference area: planes of key images (STR-5), and residuals of the other reference images that
// motion refers to (DEC-2, DEC-4). Two samples a word, rows of whole words. Every sample of a block that
// did not decode is its error (kErrorSample).

uint reference_word(uint at) {
  if (!kChunked) return OutWords(arguments.references).word[at];
  const uint log2 = arguments.shape.reference_chunk_log2;
  return OutChunks(arguments.references).chunk[at >> log2].word[low_bits(at, log2)];
}

void write_reference_word(uint at, uint value) {
  if (kChunked) {
    const uint log2 = arguments.shape.reference_chunk_log2;
    OutChunks(arguments.references).chunk[at >> log2].word[low_bits(at, log2)] = value;
  } else {
    OutWords(arguments.references).word[at] = value;
  }
}

/// Sample x of the row that begins with word `first`.
int row_sample(uint first, int x) {
  return bitfieldExtract(int(reference_word(first + (uint(x) >> 1))), 16 * (x & 1), 16);
}

/// Three samples from the first of word `at` on, or with `odd` from its second; the row has them all.
ivec3 word_samples(uint at, bool odd) {
  const int low = int(reference_word(at));
  const int high = int(reference_word(at + 1u));
  const int first = bitfieldExtract(low, 0, 16);
  const int last = high >> 16;
  return odd ? ivec3(low >> 16, bitfieldExtract(high, 0, 16), last)
             : ivec3(first, low >> 16, bitfieldExtract(high, 0, 16));
}

/// Sample (x, y) of the plane at `base`; inside the plane.
int reference_sample(uint base, PlaneShape plane, int x, int y) {
  return row_sample(base + uint(y) * plane.row_words, x);
}

/// The error of a sample of the area, or ok.
uint error_of_sample(int value) {
  return value < kErrorSample / 2 ? uint(value - kErrorSample) : ERROR_OK;
}

/// The first error of the blocks that the displaced block (bx, by) touches, row by row, or ok
/// (DEC-7). Columns and rows of weight 0 are not touched (MOT-9).
uint touched_error(Reference reference, PlaneShape plane, uint bx, uint by) {
  const uint log2 = arguments.shape.block_log2;
  const ivec2 reach = ivec2((1 << log2) - 1) + ivec2(reference.fx != 0, reference.fy != 0);
  const ivec2 place = (ivec2(bx, by) << log2) + ivec2(reference.ix, reference.iy);
  const ivec2 last = ivec2(plane.width, plane.height) - 1;
  const ivec2 first_sample = clamp(place, ivec2(0), last);
  const ivec2 last_sample = clamp(place + reach, ivec2(0), last);
  for (int ty = first_sample.y >> log2; ty <= last_sample.y >> log2; ++ty) {
    for (int tx = first_sample.x >> log2; tx <= last_sample.x >> log2; ++tx) {
      const ivec2 touched = max(first_sample, ivec2(tx, ty) << log2);
      const uint error =
          error_of_sample(reference_sample(reference.base, plane, touched.x, touched.y));
      if (error != ERROR_OK) return error;
    }
  }
  return ERROR_OK;
}
