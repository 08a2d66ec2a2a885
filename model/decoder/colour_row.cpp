#include "decoder/colour_row.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/colour_row.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "arithmetic/colour.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

// How pixels are stored: the type of a sample, and the samples of a pixel.
template <class T, size_t kCount>
struct Layout {
  using Sample = T;
  static constexpr size_t kSamples = kCount;
};

template <class Store>
void write_pixel(const ColourRow& row, size_t x, typename Store::Sample* out) {
  const size_t c = row.halved ? x / 2 : x;
  const Rgb pixel = inverse_colour({row.y[x], row.co[c], row.cg[c]}, row.depth);
  out += x * Store::kSamples;
  out[0] = static_cast<typename Store::Sample>(pixel.r);
  out[1] = static_cast<typename Store::Sample>(pixel.g);
  out[2] = static_cast<typename Store::Sample>(pixel.b);
  if (Store::kSamples == 4) out[Store::kSamples - 1] = 0;
}

void read_pixel(const uint16_t* rgb, size_t x, int16_t* y, int16_t* co, int16_t* cg) {
  const YCoCg colour = forward_colour({rgb[3 * x], rgb[3 * x + 1], rgb[3 * x + 2]});
  y[x] = static_cast<int16_t>(colour.y);
  co[x] = static_cast<int16_t>(colour.co);
  cg[x] = static_cast<int16_t>(colour.cg);
}

#if HWY_TARGET == HWY_SCALAR

void read_rgb_here(const uint16_t* rgb, size_t pixels, int16_t* y, int16_t* co, int16_t* cg) {
  for (size_t x = 0; x < pixels; ++x) read_pixel(rgb, x, y, co, cg);
}

using StoreRgb = Layout<uint16_t, 3>;
using StoreRgbx16 = Layout<uint16_t, 4>;
using StoreRgbx8 = Layout<uint8_t, 4>;

template <class Store>
void write_row(const ColourRow& row, typename Store::Sample* out) {
  for (size_t x = 0; x < row.pixels; ++x) write_pixel<Store>(row, x, out);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// Eight pixels at once: every value of COL-2 fits in 16 bits (specification, section 11).
using Lanes = hn::FixedTag<int16_t, 8>;
using Vector = hn::Vec<Lanes>;
constexpr size_t kLanes = 8;

struct Pixels {
  Vector r, g, b;
};

// COL-2.
inline Pixels inverse_colour_lanes(Vector y, Vector co, Vector cg, Vector peak) {
  const Vector zero = hn::Zero(Lanes());
  const auto clamped = [&](Vector v) { return hn::Min(hn::Max(v, zero), peak); };
  const Vector t = hn::Sub(y, hn::ShiftRight<1>(cg));
  const Vector b = hn::Sub(t, hn::ShiftRight<1>(co));
  return {clamped(hn::Add(b, co)), clamped(hn::Add(cg, t)), clamped(b)};
}

// COL-1.
void read_rgb_here(const uint16_t* rgb, size_t pixels, int16_t* y, int16_t* co, int16_t* cg) {
  const Lanes lanes;
  const hn::RebindToUnsigned<Lanes> words;
  size_t x = 0;
  for (; x + kLanes <= pixels; x += kLanes) {
    hn::Vec<decltype(words)> r, g, b;
    hn::LoadInterleaved3(words, rgb + 3 * x, r, g, b);
    const Vector orange = hn::BitCast(lanes, hn::Sub(r, b));
    const Vector t = hn::Add(hn::BitCast(lanes, b), hn::ShiftRight<1>(orange));
    const Vector green = hn::Sub(hn::BitCast(lanes, g), t);
    hn::StoreU(hn::Add(t, hn::ShiftRight<1>(green)), lanes, y + x);
    hn::StoreU(orange, lanes, co + x);
    hn::StoreU(green, lanes, cg + x);
  }
  for (; x < pixels; ++x) read_pixel(rgb, x, y, co, cg);
}

struct StoreRgb : Layout<uint16_t, 3> {
  static void store(const Pixels& p, Sample* out) {
    const hn::RebindToUnsigned<Lanes> words;
    hn::StoreInterleaved3(hn::BitCast(words, p.r), hn::BitCast(words, p.g), hn::BitCast(words, p.b),
                          words, out);
  }
};

struct StoreRgbx16 : Layout<uint16_t, 4> {
  static void store(const Pixels& p, Sample* out) {
    const hn::RebindToUnsigned<Lanes> words;
    hn::StoreInterleaved4(hn::BitCast(words, p.r), hn::BitCast(words, p.g), hn::BitCast(words, p.b),
                          hn::Zero(words), words, out);
  }
};

struct StoreRgbx8 : Layout<uint8_t, 4> {
  static void store(const Pixels& p, Sample* out) {
    const hn::FixedTag<uint8_t, 8> bytes;
    hn::StoreInterleaved4(hn::DemoteTo(bytes, p.r), hn::DemoteTo(bytes, p.g),
                          hn::DemoteTo(bytes, p.b), hn::Zero(bytes), bytes, out);
  }
};

template <class Store>
void write_row(const ColourRow& row, typename Store::Sample* out) {
  const Lanes lanes;
  const Vector peak = hn::Set(lanes, static_cast<int16_t>((1 << row.depth) - 1));
  const auto store = [&](size_t x, Vector co, Vector cg) {
    const Vector y = hn::LoadU(lanes, row.y + x);
    Store::store(inverse_colour_lanes(y, co, cg, peak), out + x * Store::kSamples);
  };
  size_t x = 0;
  if (row.halved) {
    for (; x + 2 * kLanes <= row.pixels; x += 2 * kLanes) {
      const Vector co = hn::LoadU(lanes, row.co + x / 2);
      const Vector cg = hn::LoadU(lanes, row.cg + x / 2);
      store(x, hn::InterleaveLower(lanes, co, co), hn::InterleaveLower(lanes, cg, cg));
      store(x + kLanes, hn::InterleaveUpper(lanes, co, co), hn::InterleaveUpper(lanes, cg, cg));
    }
  } else {
    for (; x + kLanes <= row.pixels; x += kLanes) {
      store(x, hn::LoadU(lanes, row.co + x), hn::LoadU(lanes, row.cg + x));
    }
  }
  for (; x < row.pixels; ++x) write_pixel<Store>(row, x, out);
}

#endif  // HWY_TARGET == HWY_SCALAR

void write_rgb_here(const ColourRow& row, uint16_t* out) { write_row<StoreRgb>(row, out); }
void write_rgbx8_here(const ColourRow& row, uint8_t* out) { write_row<StoreRgbx8>(row, out); }
void write_rgbx16_here(const ColourRow& row, uint16_t* out) { write_row<StoreRgbx16>(row, out); }

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(read_rgb_here);
HWY_EXPORT(write_rgb_here);
HWY_EXPORT(write_rgbx8_here);
HWY_EXPORT(write_rgbx16_here);

void read_rgb(const uint16_t* rgb, size_t pixels, int16_t* y, int16_t* co, int16_t* cg) {
  HWY_DYNAMIC_DISPATCH(read_rgb_here)(rgb, pixels, y, co, cg);
}

void write_rgb(const ColourRow& row, uint16_t* out) {
  HWY_DYNAMIC_DISPATCH(write_rgb_here)(row, out);
}

void write_rgbx(const ColourRow& row, uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(write_rgbx8_here)(row, out);
}

void write_rgbx(const ColourRow& row, uint16_t* out) {
  HWY_DYNAMIC_DISPATCH(write_rgbx16_here)(row, out);
}

Rect chroma_rect(const Rect& rect, bool halved) {
  if (!halved) return rect;
  const uint32_t x = rect.x >> 1;
  const uint32_t y = rect.y >> 1;
  return {x, y, ((rect.x + rect.width - 1) >> 1) - x + 1,
          ((rect.y + rect.height - 1) >> 1) - y + 1};
}

RgbImage rgb_picture(const std::array<SamplePlane, kPlaneCount>& planes, const Rect& rect,
                     bool halved, int depth) {
  RgbImage image{rect.width, rect.height, depth, {}};
  image.samples.resize(size_t{rect.width} * rect.height * 3);
  const Rect chroma = chroma_rect(rect, halved);
  const unsigned shift = halved ? 1 : 0;
  // A first pixel at an odd x has the second half of its sample of chroma.
  const bool odd = halved && rect.x % 2 != 0;
  for (uint32_t y = 0; y < rect.height; ++y) {
    const auto luma = planes[0].row(y);
    const uint32_t row = ((rect.y + y) >> shift) - chroma.y;
    const int16_t* co = planes[1].row(row).data();
    const int16_t* cg = planes[2].row(row).data();
    uint16_t* out = image.samples.data() + size_t{y} * rect.width * 3;
    if (odd) write_rgb({luma.data(), co, cg, 1, true, depth}, out);
    const uint32_t first = odd ? 1 : 0;
    write_rgb({luma.data() + first, co + first, cg + first, rect.width - first, halved, depth},
              out + 3 * first);
  }
  return image;
}

}  // namespace hmlfc

#endif  // HWY_ONCE
