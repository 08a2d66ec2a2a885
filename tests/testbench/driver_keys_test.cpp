// Key images that the driver cannot decode for reasons that no vector has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "driver/hmlfc_driver.h"
#include "driver/hmlfc_openjpeg.h"
#include "io/files.hpp"

namespace hmlfc::tb {
namespace {

// A vector, opened, and room for what the driver makes of it.
class DriverKeys : public testing::Test {
 protected:
  void SetUp() override {
    const auto mapped = io::map_file(HMLFC_VECTORS "/syntax/base-reference.hmlfc");
    ASSERT_TRUE(mapped) << mapped.error().message;
    file.assign(mapped->bytes().begin(), mapped->bytes().end());
    ASSERT_EQ(hmlfc_stream_open(&stream, file.data(), file.size(), nullptr, &error), HMLFC_OK);
    area.resize(stream.area_bytes);
    samples.resize(size_t{stream.width} * stream.height);
  }

  uint64_t fill(hmlfc_decode_plane decode, void* context) {
    const hmlfc_buffer buffer{area.data(), 0, area.size()};
    uint64_t failed = 0;
    const size_t count = samples.size();
    const auto fill = [&](const hmlfc_buffer& to, size_t room) {
      return hmlfc_fill_key_images(&stream, &to, decode, context, samples.data(), room, &failed,
                                   &error);
    };
    EXPECT_EQ(fill({area.data(), 0, area.size() - 1}, count), HMLFC_BAD_ARGUMENT);
    EXPECT_EQ(fill(buffer, count - 1), HMLFC_BAD_ARGUMENT);
    EXPECT_EQ(fill(buffer, count), HMLFC_OK);
    return failed;
  }

  std::vector<uint8_t> file;
  hmlfc_stream stream;
  hmlfc_error error;
  std::vector<uint8_t> area;
  std::vector<int16_t> samples;
};

// Memory of a stream that changes after it was opened.
TEST_F(DriverKeys, LieInTheStreamOrAreErrors) {
  const auto entry = file.begin() + static_cast<ptrdiff_t>(stream.sections[0].offset);
  std::fill_n(entry, 6, uint8_t{0xFF});  // of the first codestream's offset
  EXPECT_EQ(fill(hmlfc_openjpeg_decode, nullptr), 1u);
  EXPECT_EQ(error.code, HMLFC_BAD_TOP_ENTRY);
  EXPECT_EQ(error.offset, stream.sections[0].offset);
}

TEST_F(DriverKeys, TellWantOfMemoryFromDamage) {
  constexpr std::pair<int, int> kCases[] = {{HMLFC_OUT_OF_MEMORY, HMLFC_OUT_OF_MEMORY},
                                            {HMLFC_BAD_TOP_CRC, HMLFC_BAD_TOP_CRC},
                                            {1, HMLFC_BAD_TOP_CRC}};
  for (const auto& [given, expected] : kCases) {
    const auto decode = [](void* context, const uint8_t*, size_t, uint32_t, uint32_t, unsigned, int,
                           int16_t*) { return *static_cast<const int*>(context); };
    int code = given;
    EXPECT_EQ(fill(decode, &code), stream.key_images * HMLFC_PLANES);
    EXPECT_EQ(error.code, expected);
  }
}

}  // namespace
}  // namespace hmlfc::tb
