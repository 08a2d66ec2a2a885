// The check itself: faults planted in what the device decodes are found, at the stage they are in.
#include <string>

#include <hmlfc/decoder.hpp>

#include "decoder/key_images.hpp"
#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuCheck : public GpuTest {
 protected:
  // The first difference between `damaged` on the device and the intact stream in the model.
  static std::string difference(const std::vector<uint8_t>& damaged,
                                const std::vector<uint8_t>& intact, bool stages) {
    const auto result =
        check_bytes(device(), damaged, intact, {.requests = 3000, .stages = stages});
    if (!result || !result->mismatch) return "none";
    return to_string(*result->mismatch);
  }
};

// The field of a block that the model reads last.
class LastField final : public TraceSink {
 public:
  explicit LastField(std::string_view name) : name_(name) {}
  void on_field(const FieldRecord& record) override {
    if (record.name == name_ && record.bits != 0) bit = record.bit;
  }
  void on_stage(const StageRecord&) override {}

  uint64_t bit = 0;

 private:
  std::string_view name_;
};

// The address of a bit of some field `name` of the stream, 0 where there is none.
uint64_t bit_of(const std::vector<uint8_t>& bytes, std::string_view name) {
  const auto decoder = Decoder::open(bytes);
  LastField sink(name);
  const PlaneSize size = decoder->plane_size(Plane::kY);
  const unsigned b = decoder->header().block_size();
  for (uint32_t by = 0; by * b < size.height; ++by) {
    for (uint32_t bx = 0; bx * b < size.width; ++bx) {
      static_cast<void>(decoder->decode_block({{0, 0}, Plane::kY, bx, by}, {.trace = &sink}));
    }
  }
  return sink.bit;
}

std::vector<uint8_t> with_flipped_bit(std::vector<uint8_t> bytes, uint64_t bit) {
  bytes[static_cast<size_t>(bit / 8)] ^= static_cast<uint8_t>(1u << bit % 8);
  return bytes;
}

TEST_F(GpuCheck, FindsAChangedValueAtItsStage) {
  const auto intact = tb::suite_stream(2, 4);
  const uint64_t bit = bit_of(intact, "value");
  ASSERT_NE(bit, 0u);
  const std::string found = difference(with_flipped_bit(intact, bit), intact, true);
  EXPECT_NE(found.find("residual: sample ("), std::string::npos) << found;
  EXPECT_NE(found.find("at level "), std::string::npos) << found;
  const std::string answer = difference(with_flipped_bit(intact, bit), intact, false);
  EXPECT_NE(answer.find("answer: sample ("), std::string::npos) << answer;
}

TEST_F(GpuCheck, FindsAChangedVectorAndAChangedSign) {
  for (uint32_t seed = 0; seed < 40; seed += 2) {  // profile main
    const auto intact = tb::suite_stream(seed, 4);
    const uint64_t bit = bit_of(intact, "sign_mode");
    if (bit == 0) continue;
    const std::string found = difference(with_flipped_bit(intact, bit), intact, true);
    EXPECT_NE(found.find("vector: "), std::string::npos) << found;
    return;
  }
  FAIL() << "no stream with motion";
}

TEST_F(GpuCheck, FindsAMissingKeyImage) {
  const auto intact = tb::suite_stream(2, 4);
  const auto view = open_stream(intact, {});
  ASSERT_TRUE(view);
  auto damaged = intact;
  // sample_crc of the first plane of the first key image (KEY-1).
  damaged[static_cast<size_t>(view->entry(Section::kTop).offset) + kTopEntryBytes - 1] ^= 1;
  const std::string found = difference(damaged, intact, true);
  EXPECT_NE(found.find("error: error: expected 0, actual 14"), std::string::npos) << found;
}

TEST_F(GpuCheck, FindsNothingInTheIntactStream) {
  const auto intact = tb::suite_stream(2, 4);
  EXPECT_EQ(difference(intact, intact, true), "none");
}

}  // namespace
}  // namespace hmlfc::gpu
