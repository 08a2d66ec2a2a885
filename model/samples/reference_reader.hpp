// Fast reading of reference values at any place, equal to gather_reference.
#pragma once

#include <cstdint>
#include <memory>

#include <hmlfc/error.hpp>

#include "fields/geometry.hpp"
#include "samples/block_decoder.hpp"
#include "samples/sample_plane.hpp"
#include "samples/sparse_plane.hpp"

namespace hmlfc {

/// One plane of the reference image of one group: a key image or sparse residuals (DEC-4).
class ReferenceReader {
 public:
  /// The reference of image `image` of level `level`; `sources.references` must be set.
  static Result<ReferenceReader> open(const DecodeSources& sources, int level, ImagePos image,
                                      Plane plane);

  /// Writes ref(x + i, y + j) for i, j in [0, B - 1] to `out`, row by row, with the border rule
  /// (DEC-5).
  Result<void> read(int32_t x, int32_t y, int16_t* out) const;

 private:
  ReferenceReader(const PlaneShape& plane, unsigned block_size)
      : plane_(plane), block_size_(block_size) {}

  bool is_inside(int32_t x, int32_t y) const;
  Result<void> read_clamped(int32_t x, int32_t y, int16_t* out) const;
  void read_key(uint32_t x, uint32_t y, int16_t* out) const;
  Result<void> read_sparse(uint32_t x, uint32_t y, int16_t* out) const;
  Result<int16_t> sample(uint32_t x, uint32_t y) const;

  PlaneShape plane_;
  unsigned block_size_;
  std::shared_ptr<const SamplePlane> key_;  // exactly one of these two is set
  std::shared_ptr<const SparsePlane> sparse_;
};

}  // namespace hmlfc
