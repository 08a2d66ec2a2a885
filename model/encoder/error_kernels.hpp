// Sums over many samples: squared errors of 4x4 samples, on which decisions about motion rest
// (ResidualEstimate), and errors by the samples that predictions come from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hmlfc {

/// At most four rows of samples, and predictions of them, whose differences lie in [-2^15, 2^15).
/// Rows of a stride, which is that of the samples and another one of all predictions.
struct SquareRow {
  const int16_t* target;
  size_t target_stride;
  size_t predicted_stride;
  unsigned columns;
  unsigned rows;
};

/// The squared errors of `predicted`: out[i] is that of columns 4 i to 4 i + 3.
void square_errors(const SquareRow& row, const int16_t* predicted, uint32_t* out);

/// Those of each reference set (MOT-7), out[set * stride + i], with `predicted` from K0 to K3. The
/// mean of two predictions is not rounded, which is near enough to decide on.
void set_errors(const SquareRow& row, const std::array<const int16_t*, 4>& predicted, uint32_t* out,
                size_t stride);

/// Rows of values, for predictions that were interpolated with fractions fx and fy in [0, 7]
/// (MOT-9). On each side of a row there is a 0, to the right kSpreadAhead of them.
struct SpreadRows {
  const int32_t* values;
  size_t stride;
  unsigned columns;
  unsigned rows;
  int32_t fx;
  int32_t fy;
};
constexpr unsigned kSpreadAhead = 16;

/// Adds the values to the samples that predictions come from, times the weights that these have:
/// from `out` on, where there are one row and kSpreadAhead columns more. Sums wrap around.
void spread(const SpreadRows& from, int32_t* out, size_t stride);

}  // namespace hmlfc
