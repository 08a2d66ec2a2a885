// Key images with missing coding passes: the reconstruction rule and the order of clamp, CRC and
// range (EXT-6, KEY-3).
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "decoder/naive_stream.hpp"
#include "decoder/openjpeg_sink.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr uint32_t kCodeBlock = 16;

/// A codestream of `resolutions` resolutions and code-blocks of 16 x 16, cut by rate to about
/// 1 / `ratio` of its samples' bytes.
Bytes lossy_codestream(const SamplePlane& plane, SamplePrecision precision, int resolutions,
                       float ratio) {
  openjpeg::Sink sink;
  opj_image_cmptparm_t component{};
  component.dx = component.dy = 1;
  component.w = plane.width;
  component.h = plane.height;
  component.prec = static_cast<OPJ_UINT32>(precision.bits);
  component.sgnd = precision.is_signed ? 1 : 0;
  const openjpeg::Image image(opj_image_create(1, &component, OPJ_CLRSPC_GRAY));
  image->x1 = plane.width;
  image->y1 = plane.height;
  std::copy(plane.samples.begin(), plane.samples.end(), image->comps[0].data);
  const openjpeg::Stream stream = openjpeg::open_sink(sink);
  const openjpeg::Codec codec(opj_create_compress(OPJ_CODEC_J2K));
  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.numresolution = resolutions;
  parameters.cblockw_init = parameters.cblockh_init = static_cast<int>(kCodeBlock);
  parameters.irreversible = 0;
  parameters.tcp_numlayers = 1;
  parameters.tcp_rates[0] = ratio;
  parameters.cp_disto_alloc = 1;
  char no_comment[] = "";
  parameters.cp_comment = no_comment;
  EXPECT_TRUE(opj_setup_encoder(codec.get(), &parameters, image.get()) &&
              opj_start_compress(codec.get(), image.get(), stream.get()) &&
              opj_encode(codec.get(), stream.get()) && opj_end_compress(codec.get(), stream.get()));
  return sink.bytes;
}

// EXT-6 for one coefficient of which plane `b` is the lowest that was coded.
int reconstructed(int coefficient, int b) {
  int magnitude = std::abs(coefficient);
  for (int i = 0; i < b; ++i) magnitude /= 2;
  if (magnitude == 0) return 0;
  int value = magnitude;
  for (int i = 0; i < b; ++i) value *= 2;
  if (b > 0) value += 1 << (b - 1);
  return coefficient < 0 ? -value : value;
}

// Whether a value is 0 or stands for some magnitude of which plane `b` is the lowest.
bool has_form(int value, int b) {
  const int side = 1 << b;
  const int magnitude = std::abs(value);
  return value == 0 || (magnitude >= side && magnitude % side == side / 2);
}

/// What a code-block became: the greatest b such that each value has the form of plane b or b + 1
/// (-1 where there is none), and the values that do not stand for what was coded.
struct BlockFit {
  int b = -1;
  int others = 0;
};

BlockFit fit_block(const SamplePlane& in, const SamplePlane& out, uint32_t x0, uint32_t y0,
                   int level_shift) {
  BlockFit best;
  for (int b = 0; b <= 12; ++b) {
    BlockFit fit{b, 0};
    for (uint32_t y = y0; y < std::min(y0 + kCodeBlock, in.height); ++y) {
      for (uint32_t x = x0; x < std::min(x0 + kCodeBlock, in.width); ++x) {
        const int was = in.at(x, y) - level_shift;
        const int is = out.at(x, y) - level_shift;
        if (!has_form(is, b) && !has_form(is, b + 1)) fit.b = -1;
        fit.others += is != reconstructed(was, b) && is != reconstructed(was, b + 1) ? 1 : 0;
      }
    }
    if (fit.b >= 0) best = fit;
  }
  return best;
}

// With one resolution there is no transform: coefficients are the samples less the level shift.
TEST(LossyKeys, CoefficientsAreReconstructedAsStated) {
  std::mt19937 random(1);
  int lossless_blocks = 0;
  int others = 0;
  int lossy_blocks = 0;
  for (const bool is_signed : {false, true}) {
    for (const int bits : {8, 10, 13}) {
      for (const float ratio : {1.3f, 2.0f, 4.0f, 9.0f}) {
        const SamplePrecision precision{bits, is_signed};
        const int level_shift = is_signed ? 0 : 1 << (bits - 1);
        // Half of the range, so that no reconstruction leaves it, and quieter to the right.
        const int reach = 1 << (bits - 2);
        SamplePlane plane(60, 44);
        for (uint32_t y = 0; y < plane.height; ++y) {
          for (uint32_t x = 0; x < plane.width; ++x) {
            const int most = std::max(1, reach >> (x / 16));
            plane.samples[y * plane.width + x] =
                static_cast<int16_t>(level_shift + test::draw(random, -most + 1, most - 1));
          }
        }
        const Bytes codestream = lossy_codestream(plane, precision, 1, ratio);
        const auto decoded = decode_jpeg2000(codestream, plane.width, plane.height, precision);
        ASSERT_TRUE(decoded.has_value()) << bits << " bits at 1 : " << ratio;
        for (uint32_t y = 0; y < plane.height; y += kCodeBlock) {
          for (uint32_t x = 0; x < plane.width; x += kCodeBlock) {
            const BlockFit fit = fit_block(plane, *decoded, x, y, level_shift);
            ASSERT_GE(fit.b, 0) << "code-block at " << x << ", " << y << " of " << bits
                                << " bits at 1 : " << ratio;
            // OpenJPEG cuts the last pass at an estimate of its length: what a decoder reads behind
            // the cut may be another value, of the same form.
            ASSERT_LE(fit.others, 2);
            others += fit.others;
            ++(fit.b > 0 ? lossy_blocks : lossless_blocks);
          }
        }
      }
    }
  }
  EXPECT_GT(lossy_blocks, 100);
  EXPECT_LT(others, lossy_blocks / 10);
}

// Cut codestreams with the transform decode as well; cut files do not.
TEST(LossyKeys, MissingPassesDecodeMissingBytesDoNot) {
  std::mt19937 random(2);
  SamplePlane plane(70, 50);
  for (size_t i = 0; i < plane.samples.size(); ++i) {
    plane.samples[i] =
        static_cast<int16_t>((static_cast<int>(i % 70 * 3) + test::draw(random, 0, 40)) % 256);
  }
  for (const float ratio : {2.0f, 5.0f, 20.0f}) {
    const Bytes codestream = lossy_codestream(plane, {8, false}, 4, ratio);
    const auto decoded = decode_jpeg2000(codestream, 70, 50, {8, false});
    ASSERT_TRUE(decoded.has_value());
    EXPECT_NE(decoded->samples, plane.samples) << "1 : " << ratio << " is not lossless";
    for (size_t length = 0; length + 3 < codestream.size(); length += 7) {
      EXPECT_FALSE(
          decode_jpeg2000(std::span(codestream).first(length), 70, 50, {8, false}).has_value())
          << length << " of " << codestream.size();
    }
  }
}

// One key image, whose plane Co holds -256, which no colour has.
struct KeyStream {
  Bytes file;

  KeyStream(uint32_t flags, bool crc_of_clamped) {
    StreamHeader header;
    header.profile = flags == 0 ? Profile::kMain : Profile::kExtended;
    header.feature_flags = flags;
    header.width = header.height = 12;
    header.chroma_format = ChromaFormat::k444;
    header.levels = {{1, 1}};
    std::vector<std::pair<Bytes, uint32_t>> codestreams;
    for (const Plane plane : kPlanes) {
      const SamplePrecision precision{plane == Plane::kY ? 8 : 9, plane != Plane::kY};
      SamplePlane samples(12, 12);
      if (plane == Plane::kCo) samples.samples[5] = -256;
      const Bytes codestream = encode_jpeg2000(samples, precision).value();
      if (plane == Plane::kCo && crc_of_clamped) samples.samples[5] = -255;
      codestreams.emplace_back(codestream, test::naive_sample_crc(samples));
    }
    const test::NaiveTree tree(header);
    auto sections = test::naive_index({}, tree.tiles().size());
    sections[0] = test::naive_top(codestreams);
    file = test::naive_file(header, sections);
  }

  std::string outcome() const {
    const StreamHeader header = parse_header(file).value();
    const StreamView stream{file, header, Geometry(header)};
    const auto plane = KeyImages(stream).plane(0, {0, 0}, Plane::kCo);
    if (!plane) return std::string(error_name(plane.error().code));
    return std::to_string((*plane)->samples[5]);
  }
};

TEST(LossyKeys, SamplesAreClampedBeforeTheCrc) {
  const uint32_t lossy = feature_bit(Feature::kLossyKeys);
  EXPECT_EQ(KeyStream(lossy, true).outcome(), "-255");
  EXPECT_EQ(KeyStream(lossy, false).outcome(), "bad_top_crc");
  for (const uint32_t others : {0u, 511u - lossy - 62u}) {
    EXPECT_EQ(KeyStream(others, true).outcome(), "bad_top_crc");
    EXPECT_EQ(KeyStream(others, false).outcome(), "top_sample_range");
  }
}

}  // namespace
}  // namespace hmlfc
