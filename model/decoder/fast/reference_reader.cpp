#include "decoder/fast/reference_reader.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"

namespace hmlfc {
namespace {

uint32_t inside(int32_t coordinate, uint32_t size) {
  return static_cast<uint32_t>(clamp(coordinate, 0, static_cast<int32_t>(size) - 1));
}

}  // namespace

Result<ReferenceReader> ReferenceReader::open(const FastSources& sources, int level,
                                              ImagePos reference, Plane plane) {
  const Geometry& geometry = sources.stream.geometry;
  ReferenceReader reader(geometry.plane(plane), geometry.block_size());
  if (geometry.level(level).keyed) {
    auto key = sources.key_plane(level, reference, plane);
    if (!key) return tl::unexpected(key.error());
    reader.key_ = *key;
  } else {
    reader.sparse_ = sources.references.plane(level, reference, plane);
  }
  return reader;
}

Result<ReferenceView> ReferenceReader::copied_view(const ReferenceArea& area, bool whole,
                                                   int16_t* buffer) const {
  const ReferenceView copied{buffer, area.columns};
  if (key_) {
    read_key(area, buffer);
    return copied;
  }
  const auto read = whole ? read_sparse(area, buffer) : read_clamped(area, buffer);
  if (!read) return tl::unexpected(read.error());
  return copied;
}

// Before the first and after the last column of the plane, these repeat.
void ReferenceReader::read_key(const ReferenceArea& area, int16_t* out) const {
  const auto columns = static_cast<int32_t>(area.columns);
  const int32_t before = clamp(-area.x, 0, columns);
  const int32_t end = clamp(static_cast<int32_t>(plane_.width) - area.x, before, columns);
  for (unsigned j = 0; j < area.rows; ++j) {
    const auto row = key_->row(inside(area.y + static_cast<int32_t>(j), plane_.height));
    out = std::fill_n(out, before, row.front());
    out = std::copy_n(row.data() + (area.x + before), end - before, out);
    out = std::fill_n(out, columns - end, row.back());
  }
}

Result<void> ReferenceReader::read_clamped(const ReferenceArea& area, int16_t* out) const {
  for (unsigned j = 0; j < area.rows; ++j) {
    const uint32_t row = inside(area.y + static_cast<int32_t>(j), plane_.height);
    for (unsigned i = 0; i < area.columns; ++i) {
      const auto value = sample(inside(area.x + static_cast<int32_t>(i), plane_.width), row);
      if (!value) return tl::unexpected(value.error());
      *out++ = *value;
    }
  }
  return {};
}

// Copies the parts of the blocks that `area`, which lies in the plane, touches; zeros for those
// without residuals.
Result<void> ReferenceReader::read_sparse(const ReferenceArea& area, int16_t* out) const {
  const unsigned size = block_size_;
  const auto x = static_cast<uint32_t>(area.x);
  const auto y = static_cast<uint32_t>(area.y);
  uint32_t rows = 0;
  for (uint32_t row = 0; row < area.rows; row += rows) {
    const uint32_t in_y = (y + row) % size;
    rows = std::min(area.rows - row, size - in_y);
    uint32_t cols = 0;
    for (uint32_t col = 0; col < area.columns; col += cols) {
      const uint32_t in_x = (x + col) % size;
      cols = std::min(area.columns - col, size - in_x);
      const auto block = sparse_->find((x + col) / size, (y + row) / size);
      if (!block) return tl::unexpected(block.error());
      for (uint32_t j = 0; j < rows; ++j) {
        int16_t* target = out + size_t{row + j} * area.columns + col;
        if (*block == nullptr) {
          std::fill_n(target, cols, int16_t{0});
        } else {
          std::copy_n(*block + size_t{in_y + j} * size + in_x, cols, target);
        }
      }
    }
  }
  return {};
}

Result<int16_t> ReferenceReader::sample(uint32_t x, uint32_t y) const {
  const auto block = sparse_->find(x / block_size_, y / block_size_);
  if (!block) return tl::unexpected(block.error());
  if (*block == nullptr) return int16_t{0};
  return (*block)[(y % block_size_) * block_size_ + x % block_size_];
}

}  // namespace hmlfc
