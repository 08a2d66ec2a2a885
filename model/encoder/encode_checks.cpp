#include "encoder/encode_checks.hpp"

#include "encoder/coding_params.hpp"

namespace hmlfc {

const char* problem_of(const LightFieldShape& shape, const EncodeParams& params) {
  const EncodeParams complete = with_defaults(params);
  EncodeParams checked = complete;  // what is left to a trial passes any check
  checked.ref_rows = std::max(1u, complete.ref_rows);
  checked.ref_cols = std::max(1u, complete.ref_cols);
  checked.chroma = complete.chroma.value_or(ChromaFormat::k420);
  const double quality = params.extended.quality;
  if (!(quality >= lowest_quality(shape.depth) && quality <= kHighestQuality)) {
    return "the quality is outside [0, 132]; the least is -32 for samples of 10 bits, -64 for 12";
  }
  const unsigned grid = params.extended.disparity_grid;
  if (grid != 0 && grid != 4 && grid != 8) return kOutsideInterval;
  if (!header_for(shape, checked)) return kOutsideInterval;
  return nullptr;
}

}  // namespace hmlfc
