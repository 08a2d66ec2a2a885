// Key images with missing coding passes: what decodes, and the order of clamp, CRC and range
// (EXT-6, KEY-3). The decoder in Python has the reconstruction rule.
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

// Cut codestreams with the transform decode as well; cut files do not.
TEST(LossyKeys, MissingPassesDecodeMissingMarkersDoNot) {
  std::mt19937 random(2);
  SamplePlane plane(70, 50);
  for (size_t i = 0; i < plane.samples.size(); ++i) {
    plane.samples[i] =
        static_cast<int16_t>((static_cast<int>(i % 70 * 3) + test::draw(random, 0, 40)) % 256);
  }
  for (const double error : {5.0, 50.0, 500.0}) {
    const Bytes codestream = encode_jpeg2000_lossy(plane, {8, false}, error).value();
    const auto decoded = decode_jpeg2000(codestream, 70, 50);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_NE(decoded->samples, plane.samples) << "an error of " << error << " is not lossless";
    for (size_t length = 0; length + 3 < codestream.size(); length += 7) {
      EXPECT_FALSE(has_key_image_head(std::span(codestream).first(length), 70, 50, {8, false}))
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
    std::vector<Bytes> codestreams;
    std::vector<uint32_t> crcs;
    for (const Plane plane : kPlanes) {
      const SamplePrecision precision{plane == Plane::kY ? 8 : 9, plane != Plane::kY};
      SamplePlane samples(12, 12);
      if (plane == Plane::kCo) samples.samples[5] = -256;
      codestreams.push_back(encode_jpeg2000(samples, precision).value());
      if (plane == Plane::kCo && crc_of_clamped) samples.samples[5] = -255;
      crcs.push_back(sample_crc(samples));
    }
    file = test::file_of(header, {top_section(codestreams, crcs), Bytes(16), {}, {}});
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
