// The samples of a run of pixels, from the pixels of all its views: a vector of pixels at a time,
// the four samples of a pixel in a block of 128 bits. Included once for each instruction set by
// row_kernels.cpp.

#if defined(HMLFC_RENDER_RUN_SAMPLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HMLFC_RENDER_RUN_SAMPLES_INL
#undef HMLFC_RENDER_RUN_SAMPLES_INL
#else
#define HMLFC_RENDER_RUN_SAMPLES_INL
#endif

#include <type_traits>

#include <hwy/highway.h>

#include "render/row_kernels.hpp"
#include "render/taps.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

template <int kSampleBytes>
void write_samples(const RayRun& run, const RunTaps& taps, const RunViews& views, uint16_t* out) {
  using Sample = std::conditional_t<kSampleBytes == 1, uint8_t, uint16_t>;
  constexpr int kMaxDepth = kSampleBytes == 1 ? 8 : 12;
  const auto cols = static_cast<size_t>(taps.cols.views);
  const auto rows = static_cast<size_t>(taps.rows.views);
  const auto taps_of = [](const AxisRun& axis, size_t k, size_t i) {
    return AxisTaps{axis.first[k][i], axis.pixel_weights[k][i] >> 16};
  };
  const auto end = static_cast<size_t>(run.end);
  for (auto i = static_cast<size_t>(run.begin); i < end; ++i, out += 3) {
    uint32_t sums[3] = {};
    for (size_t view = 0; view < rows * cols; ++view) {
      const size_t row = view / cols;
      const size_t col = view % cols;
      const AxisTaps x = taps_of(taps.cols, col, i);
      const AxisTaps y = taps_of(taps.rows, row, i);
      const auto weight =
          static_cast<uint32_t>(taps.cols.weight[col][i] * taps.rows.weight[row][i]);
      const auto pixels = [&](int32_t at) {
        return reinterpret_cast<const Sample*>(views.rows[view][at]) + ptrdiff_t{4} * x.first;
      };
      const Sample* above = pixels(y.first);
      const Sample* below = pixels(y.last());
      for (int32_t k = 0; k < 3; ++k) {
        sums[k] += weight * static_cast<uint32_t>(interpolate_pixels(
                                x, y, above[k], above[k + 4], below[k], below[k + 4], kMaxDepth));
      }
    }
    for (int32_t k = 0; k < 3; ++k) {
      out[k] = static_cast<uint16_t>(frame_sample(sums[k], kMaxDepth));
    }
  }
}

inline void sample_run_here(const RayRun& run, const RunTaps& taps, const RunViews& views,
                            bool /*interpolated*/, uint16_t* out) {
  views.two_bytes ? write_samples<2>(run, taps, views, out)
                  : write_samples<1>(run, taps, views, out);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kBlockBytes = 16;
constexpr size_t kVectorPixels = HWY_MAX_BYTES / kBlockBytes;
static_assert(kVectorPixels <= AxisRun::kSpare && kVectorPixels <= 4);

using Bytes = hn::FixedTag<uint8_t, kVectorPixels * kBlockBytes>;
using Words = hn::FixedTag<uint16_t, kVectorPixels * kBlockBytes / 2>;
using Sums = hn::FixedTag<uint32_t, kVectorPixels * kBlockBytes / 4>;
using WordVector = hn::Vec<Words>;
using SumVector = hn::Vec<Sums>;

/// A vector of blocks; block k, one of a Block of values, is block_of(k).
template <class Tag, class BlockOf>
HWY_INLINE hn::Vec<Tag> vector_of(Tag tag, size_t first, const BlockOf& block_of) {
  if constexpr (sizeof(hn::TFromD<Tag>) * hn::MaxLanes(Tag()) == kBlockBytes) {
    return block_of(first);
  } else {
    const hn::Half<Tag> half;
    constexpr size_t kBlocks = sizeof(hn::TFromD<Tag>) * hn::MaxLanes(half) / kBlockBytes;
    const auto lower = vector_of(half, first, block_of);
    return hn::Combine(tag, vector_of(half, first + kBlocks, block_of), lower);
  }
}

/// In each block of `tag` the block's own of the 32-bit values at `values`, its bytes in the order
/// of a pattern.
class OfPixels {
 public:
  /// Bytes `at[0...3]` of each value, repeated.
  explicit OfPixels(const uint8_t (&at)[4]) {
    HWY_ALIGN uint8_t bytes[kVectorPixels * kBlockBytes];
    for (size_t k = 0; k < sizeof(bytes); ++k) {
      bytes[k] = static_cast<uint8_t>(4 * (k / kBlockBytes) + at[k % 4]);
    }
    pattern_ = hn::Load(Bytes(), bytes);
  }

  SumVector operator()(const int32_t* values) const {
    const Sums sums;
    const auto loaded = hn::LoadDup128(sums, reinterpret_cast<const uint32_t*>(values));
    return hn::BitCast(sums, hn::TableLookupBytes(hn::BitCast(Bytes(), loaded), pattern_));
  }

 private:
  hn::Vec<Bytes> pattern_;
};

constexpr uint8_t kWhole[4] = {0, 1, 2, 3};
constexpr uint8_t kUpperHalf[4] = {2, 3, 2, 3};

/// The sums of products of neighbours, in 32 bits.
inline SumVector add_products(WordVector words, SumVector weights) {
  const hn::RebindToSigned<Words> words_tag;
  const hn::RebindToSigned<Sums> sums_tag;
  auto upper = hn::Zero(sums_tag);
  const auto lower =
      hn::ReorderWidenMulAccumulate(sums_tag, hn::BitCast(words_tag, words),
                                    hn::BitCast(words_tag, weights), hn::Zero(sums_tag), upper);
  return hn::BitCast(Sums(), hn::RearrangeToOddPlusEven(lower, upper));
}

/// q of SMP-2 for a vector of pixels of a view. A row of views has one Row of weights.
template <int kSampleBytes>
class Interpolation;

/// Samples of one byte: rows are interpolated in 16 bits, then columns as sums of products.
template <>
class Interpolation<1> {
 public:
  using Row = WordVector;

  Row row(const int32_t* pixel_weights) const {
    return hn::BitCast(Words(), below_(pixel_weights));
  }

  /// Blocks of two pixels above and the two below.
  template <class PairOf>
  HWY_INLINE SumVector operator()(const PairOf& pair_of, Row below_weights,
                                  const int32_t* pixel_weights) const {
    const Words words;
    const hn::FixedTag<uint8_t, kBlockBytes> block;
    const auto load = [&](const uint8_t* pixels) {
      return hn::ZeroExtendVector(block, hn::LoadU(hn::FixedTag<uint8_t, 8>(), pixels));
    };
    // Each word is 256 * above + below.
    const WordVector both =
        hn::BitCast(words, vector_of(Bytes(), 0, [&](size_t k) {
                      const auto [above, below] = pair_of(k);
                      return hn::InterleaveLower(block, load(below), load(above));
                    }));
    const WordVector lower = hn::And(both, hn::Set(words, uint16_t{255}));
    const WordVector step = hn::Sub(lower, hn::ShiftRight<8>(both));
    // 256 times the mean of above and below, at most 65280: exact modulo 2^16. 2^15 less fits in
    // the signed factors of add_products().
    const WordVector mean = hn::Xor(hn::Add(hn::Sub(both, lower), hn::Mul(step, below_weights)),
                                    hn::Set(words, uint16_t{1} << 15));
    const auto pairs = hn::TableLookupBytes(hn::BitCast(Bytes(), mean), neighbours_);
    const SumVector sum = add_products(hn::BitCast(words, pairs), right_(pixel_weights));
    return hn::ShiftRight<12>(hn::Add(sum, hn::Set(Sums(), (1u << 23) + (1u << 11))));
  }

 private:
  static hn::Vec<Bytes> neighbours() {
    HWY_ALIGN static constexpr uint8_t kOrder[kBlockBytes] = {0, 1, 8,  9,  2, 3, 10, 11,
                                                              4, 5, 12, 13, 6, 7, 14, 15};
    return hn::LoadDup128(Bytes(), kOrder);
  }

  OfPixels below_{kUpperHalf};
  OfPixels right_{kWhole};
  hn::Vec<Bytes> neighbours_ = neighbours();
};

/// Samples of two bytes: rows are interpolated as sums of products, then columns in 32 bits.
template <>
class Interpolation<2> {
 public:
  using Row = SumVector;

  Row row(const int32_t* pixel_weights) const { return whole_(pixel_weights); }

  template <class PairOf>
  HWY_INLINE SumVector operator()(const PairOf& pair_of, Row row_weights,
                                  const int32_t* pixel_weights) const {
    const Words words;
    const hn::FixedTag<uint16_t, kBlockBytes / 2> block;
    const auto load = [&](const uint8_t* pixels) {
      return hn::LoadU(block, reinterpret_cast<const uint16_t*>(pixels));
    };
    const WordVector above = vector_of(words, 0, [&](size_t k) { return load(pair_of(k).above); });
    const WordVector below = vector_of(words, 0, [&](size_t k) { return load(pair_of(k).below); });
    const SumVector left = add_products(hn::InterleaveLower(words, above, below), row_weights);
    const SumVector right = add_products(hn::InterleaveUpper(words, above, below), row_weights);
    const SumVector fraction = hn::ShiftRight<16>(whole_(pixel_weights));
    const SumVector sum = hn::Add(hn::ShiftLeft<8>(left), hn::Mul(hn::Sub(right, left), fraction));
    return hn::ShiftRight<12>(hn::Add(sum, hn::Set(Sums(), 1u << 11)));
  }

 private:
  OfPixels whole_{kWhole};
};

/// q of filters that take one pixel of a view.
template <int kSampleBytes>
class OnePixel {
 public:
  struct Row {};

  Row row(const int32_t*) const { return {}; }

  template <class PairOf>
  HWY_INLINE SumVector operator()(const PairOf& pair_of, Row, const int32_t*) const {
    using Sample = std::conditional_t<kSampleBytes == 1, uint8_t, uint16_t>;
    return hn::ShiftLeft<4>(vector_of(Sums(), 0, [&](size_t k) {
      const auto* pixel = reinterpret_cast<const Sample*>(pair_of(k).above);
      return hn::PromoteTo(hn::FixedTag<uint32_t, 4>(),
                           hn::LoadU(hn::FixedTag<Sample, 4>(), pixel));
    }));
  }
};

/// Where the two pixels above and the two below begin.
struct PixelPair {
  const uint8_t* above;
  const uint8_t* below;
};

/// Stores R, G and B of a vector of pixels; writes up to kRowSpare samples past them.
class SampleWriter {
 public:
  void operator()(SumVector sums, uint16_t* out) const {
    const auto rounded = hn::ShiftRight<20>(sums);  // fits in 16 bits
    const hn::RebindToSigned<Sums> ints;
    const hn::FixedTag<uint16_t, kVectorPixels * 4> samples;
    const auto words = hn::DemoteTo(samples, hn::BitCast(ints, rounded));
    if constexpr (kVectorPixels == 1) {
      hn::StoreU(words, samples, out);
    } else {
      // R, G, B of two pixels to the front of each block.
      HWY_ALIGN static constexpr uint8_t kOrder[kBlockBytes] = {0,  1,  2,  3,  4, 5, 8,  9,
                                                                10, 11, 12, 13, 6, 7, 14, 15};
      const hn::Repartition<uint8_t, decltype(samples)> bytes;
      const auto packed = hn::BitCast(
          samples, hn::TableLookupBytes(hn::BitCast(bytes, words), hn::LoadDup128(bytes, kOrder)));
      store_blocks(samples, packed, out);
    }
  }

 private:
  template <class Tag>
  static void store_blocks(Tag tag, hn::Vec<Tag> blocks, uint16_t* out) {
    if constexpr (hn::MaxLanes(Tag()) == kBlockBytes / 2) {
      hn::StoreU(blocks, tag, out);
    } else {
      const hn::Half<Tag> half;
      store_blocks(half, hn::LowerHalf(half, blocks), out);
      store_blocks(half, hn::UpperHalf(half, blocks), out + 6);
    }
  }
};

template <int kSampleBytes, class Filter>
void write_samples(const RayRun& run, const RunTaps& taps, const RunViews& views, uint16_t* out) {
  constexpr int32_t kPixelBytes = 4 * kSampleBytes;
  const Filter filter;
  const OfPixels whole(kWhole);
  const SampleWriter write;
  const AxisRun& cols = taps.cols;
  const AxisRun& rows = taps.rows;
  for (int32_t i = run.begin; i < run.end; i += int32_t{kVectorPixels}) {
    SumVector sum = hn::Set(Sums(), 1u << 19);
    const uint8_t* const* const* view_rows = views.rows.data();
    for (int32_t row = 0; row < rows.views; ++row) {
      const int32_t* y = rows.first[row].data() + i;
      const auto row_weights = filter.row(rows.pixel_weights[row].data() + i);
      SumVector row_sum = hn::Zero(Sums());
      for (int32_t col = 0; col < cols.views; ++col) {
        const uint8_t* const* lines = *view_rows++;
        const int32_t* x = cols.first[col].data() + i;
        const auto pair_of = [&](size_t k) {
          const uint8_t* const* line = lines + y[k];
          const auto at = static_cast<ptrdiff_t>(x[k]) * kPixelBytes;
          return PixelPair{line[0] + at, line[1] + at};
        };
        const SumVector q = filter(pair_of, row_weights, cols.pixel_weights[col].data() + i);
        row_sum = hn::Add(row_sum, hn::Mul(q, whole(cols.weight[col].data() + i)));
      }
      sum = hn::Add(sum, hn::Mul(row_sum, whole(rows.weight[row].data() + i)));
    }
    write(sum, out + ptrdiff_t{3} * (i - run.begin));
  }
}

inline void sample_run_here(const RayRun& run, const RunTaps& taps, const RunViews& views,
                            bool interpolated, uint16_t* out) {
  if (interpolated) {
    views.two_bytes ? write_samples<2, Interpolation<2> >(run, taps, views, out)
                    : write_samples<1, Interpolation<1> >(run, taps, views, out);
  } else {
    views.two_bytes ? write_samples<2, OnePixel<2> >(run, taps, views, out)
                    : write_samples<1, OnePixel<1> >(run, taps, views, out);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#endif
