// Where motion finds its reference (DEC-4, DEC-5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <hmlfc/error.hpp>

#include "decoder/block_values.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// One plane of one reference image, block by block.
class ReferenceBlocks {
 public:
  virtual ~ReferenceBlocks() = default;

  /// Block (bx, by) of the plane, which exists: key samples at the top level, residuals below it
  /// (DEC-4). Positions outside the plane have no meaning.
  virtual Result<BlockValues> block(uint32_t bx, uint32_t by) = 0;
};

/// A rectangle of reference values around a displaced block: B or B + 1 a side.
class ReferenceWindow {
 public:
  ReferenceWindow(unsigned columns, unsigned rows) : columns_(columns), rows_(rows) {}

  unsigned columns() const { return columns_; }
  unsigned rows() const { return rows_; }

  int32_t& at(unsigned x, unsigned y) { return values_[y * columns_ + x]; }
  int32_t at(unsigned x, unsigned y) const { return values_[y * columns_ + x]; }

 private:
  unsigned columns_;
  unsigned rows_;
  std::array<int32_t, size_t{kMaxBlockSize + 1} * (kMaxBlockSize + 1)> values_{};
};

/// A rectangle of a plane, which may reach outside: columns x to x + columns - 1, rows likewise;
/// not empty.
struct ReferenceArea {
  int32_t x = 0;
  int32_t y = 0;
  unsigned columns = 1;
  unsigned rows = 1;
};

/// The values of ref in `area`, of at most B + 1 columns and rows, with the border rule (DEC-5).
/// Asks for at most 2 x 2 blocks, row by row.
///
/// Example: B = 4, columns -6 to -3, rows 5 to 8 in a wide plane: all columns read column 0.
Result<ReferenceWindow> gather_reference(ReferenceBlocks& blocks, const PlaneShape& plane,
                                         unsigned block_size, const ReferenceArea& area);

}  // namespace hmlfc
