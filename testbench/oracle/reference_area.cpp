#include "oracle/reference_area.hpp"

#include <algorithm>
#include <bit>

#include "arithmetic/rounding.hpp"
#include "decoder/sample_plane.hpp"

namespace hmlfc::tb {
namespace {

constexpr unsigned kQuarters = 4;
constexpr unsigned kQuarterSamples = kStripSamples / kQuarters;
constexpr unsigned kWidthBits = 4;
constexpr unsigned kBaseBits = 16;
constexpr unsigned kHeadBits = kWidthBits + kBaseBits;
constexpr unsigned kRaw = 15;
constexpr unsigned kRawBits = 14;

bool is_poison(int32_t sample) { return sample < poison_of(ErrorCode::kOk) + 32; }

unsigned bits_of_width(unsigned width) { return width == kRaw ? kRawBits : width; }

// Whether blocks of level `l` read reference images: otherwise nothing in them is ever decoded.
bool is_read(const LevelShape& level) {
  return level.keyed || level.group_rows() != level.rows || level.group_cols() != level.cols;
}

// The blocks of one plane of one reference image, or the error of each.
class PlaneSource {
 public:
  PlaneSource(const StreamView& stream, const KeyImages& keys, const HeldReferences& references,
              const AreaPlane& plane)
      : block_size_(stream.geometry.block_size()), references_(references), plane_(plane) {
    if (stream.geometry.level(plane.level).keyed) {
      key_ = keys.plane(plane.level, plane.image, plane.plane);
    }
  }

  Result<BlockValues> block(uint32_t bx, uint32_t by) const {
    if (!key_) return tl::unexpected(key_.error());
    if (*key_) return block_of_plane(**key_, block_size_, bx, by);
    return references_.block(
        {plane_.level, plane_.image.row, plane_.image.col, plane_.plane, bx, by});
  }

 private:
  unsigned block_size_;
  const HeldReferences& references_;
  const AreaPlane& plane_;
  Result<std::shared_ptr<const SamplePlane>> key_{nullptr};
};

class AreaBuilder {
 public:
  AreaBuilder(const StreamView& stream, const KeyImages& keys, const HeldReferences& references)
      : stream_(stream), keys_(keys), references_(references) {}

  ReferenceArea build() {
    area_.layout = area_layout(stream_.geometry);
    area_.bytes.assign(static_cast<size_t>(area_.layout.size), 0);
    for (const AreaPlane& plane : area_.layout.planes) {
      if (is_read(stream_.geometry.level(plane.level))) fill_plane(plane);
    }
    return std::move(area_);
  }

 private:
  void fill_plane(const AreaPlane& plane) {
    const PlaneSource source(stream_, keys_, references_, plane);
    const PlaneShape& shape = stream_.geometry.plane(plane.plane);
    const uint32_t strips = strips_in_row(shape.width, stream_.geometry.block_size());
    uint64_t at = plane.offset;
    for (uint32_t by = 0; by < shape.blocks_y; ++by) {
      for (uint32_t s = 0; s < strips; ++s, at += kStripBytes) {
        const auto place = pack_strip(strip_samples(source, shape, s, by));
        std::copy(place.begin(), place.end(), area_.bytes.begin() + static_cast<ptrdiff_t>(at));
      }
    }
  }

  // Strip `s` of row `by`; blocks past the plane's last repeat its first sample.
  StripSamples strip_samples(const PlaneSource& source, const PlaneShape& shape, uint32_t s,
                             uint32_t by) {
    const unsigned in_block = stream_.geometry.block_size() * stream_.geometry.block_size();
    const uint32_t blocks = kStripSamples / in_block;
    StripSamples samples{};
    for (uint32_t b = 0; b < blocks; ++b) {
      const uint32_t bx = s * blocks + b;
      int32_t* const to = samples.data() + size_t{b} * in_block;
      if (bx >= shape.blocks_x) {
        std::fill_n(to, in_block, samples[0]);
        continue;
      }
      const auto block = source.block(bx, by);
      if (block) {
        std::copy(block->span().begin(), block->span().end(), to);
      } else {
        std::fill_n(to, in_block, poison_of(block.error().code));
      }
    }
    return samples;
  }

  const StreamView& stream_;
  const KeyImages& keys_;
  const HeldReferences& references_;
  ReferenceArea area_;
};

}  // namespace

void set_field(std::span<uint8_t> bytes, uint64_t position, unsigned count, uint64_t value) {
  for (unsigned i = 0; i < count; ++i) {
    const auto byte = static_cast<size_t>((position + i) >> 3);
    const auto bit = static_cast<uint8_t>(1u << ((position + i) & 7));
    bytes[byte] =
        static_cast<uint8_t>((value >> i & 1) != 0 ? bytes[byte] | bit : bytes[byte] & ~bit);
  }
}

uint32_t strips_in_row(uint32_t width, unsigned block_size) {
  const uint32_t blocks = ceil_div(width, uint32_t{block_size});
  return ceil_div(blocks, uint32_t{kStripSamples / (block_size * block_size)});
}

std::array<uint8_t, kStripBytes> pack_strip(const StripSamples& samples) {
  std::array<uint8_t, kStripBytes> place{};
  uint64_t position = uint64_t{kQuarters} * kHeadBits;
  for (unsigned q = 0; q < kQuarters; ++q) {
    const auto quarter = std::span(samples).subspan(size_t{q} * kQuarterSamples, kQuarterSamples);
    const auto [least, most] = std::minmax_element(quarter.begin(), quarter.end());
    const bool raw = is_poison(*least);
    uint32_t errors = 0;
    for (size_t i = 0; i < quarter.size(); ++i) errors |= uint32_t{is_poison(quarter[i])} << i / 4;
    const auto needed =
        static_cast<unsigned>(std::bit_width(static_cast<uint32_t>(*most - *least)));
    const unsigned width = raw ? kRaw : needed;
    const int32_t base = raw ? 0 : *least;
    set_field(place, q * kHeadBits, kWidthBits, width);
    set_field(place, q * kHeadBits + kWidthBits, kBaseBits,
              raw ? errors : static_cast<uint32_t>(base));
    for (const int32_t sample : quarter) {
      set_field(place, position, bits_of_width(width), static_cast<uint32_t>(sample - base));
      position += bits_of_width(width);
    }
  }
  return place;
}

unsigned strip_bits(std::span<const uint8_t> place) {
  unsigned bits = kQuarters * kHeadBits;
  for (unsigned q = 0; q < kQuarters; ++q) {
    const unsigned at = q * kHeadBits;
    bits += kQuarterSamples * bits_of_width(static_cast<unsigned>(place[at / 8] >> at % 8) & 15u);
  }
  return bits;
}

AreaLayout area_layout(const Geometry& geometry) {
  AreaLayout layout;
  for (int l = geometry.top(); l >= 0; --l) {
    const LevelShape& level = geometry.level(l);
    for (uint32_t row = 0; row < level.group_rows(); ++row) {
      for (uint32_t col = 0; col < level.group_cols(); ++col) {
        const ImagePos image = geometry.reference_of_group(l, {row, col});
        for (const Plane p : kPlanes) {
          const PlaneShape& shape = geometry.plane(p);
          const uint64_t strips =
              uint64_t{strips_in_row(shape.width, geometry.block_size())} * shape.blocks_y;
          layout.planes.push_back({l, image, p, layout.size, strips * kStripBytes});
          layout.size += strips * kStripBytes;
        }
      }
    }
  }
  return layout;
}

ReferenceArea build_reference_area(const StreamView& stream, const KeyImages& keys,
                                   const HeldReferences& references) {
  return AreaBuilder(stream, keys, references).build();
}

}  // namespace hmlfc::tb
