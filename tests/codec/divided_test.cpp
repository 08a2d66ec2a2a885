// A light field that is encoded part by part, in any division and order, gives the same bytes.
#include <hmlfc/divided_encoder.hpp>

#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "encoder/cached_views.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

class MemoryStorage final : public CodeStorage {
 public:
  uint64_t append(std::span<const uint8_t> bytes) override {
    const std::scoped_lock lock(mutex_);
    const uint64_t offset = bytes_.size();
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return offset;
  }

  void read(uint64_t offset, std::span<uint8_t> out) const override {
    const std::scoped_lock lock(mutex_);
    std::copy_n(bytes_.begin() + static_cast<ptrdiff_t>(offset), out.size(), out.begin());
  }

 private:
  mutable std::mutex mutex_;
  std::vector<uint8_t> bytes_;
};

std::vector<uint8_t> collected(const std::function<void(const ByteSink&)>& write) {
  std::vector<uint8_t> bytes;
  write(
      [&](std::span<const uint8_t> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
  return bytes;
}

std::vector<uint8_t> stream_of(const DividedEncoder& encoder) {
  return collected([&](const ByteSink& sink) { encoder.write({}, sink); });
}

EncodeParams params_of(Profile profile, Method method, int tree_height, bool lossless) {
  EncodeParams params;
  params.profile = profile;
  params.method = method;
  params.tree_height = tree_height;
  params.lossless = lossless;
  params.extended.preset = Preset::kFast;
  params.ref_rows = 3;
  params.ref_cols = 2;
  return params;
}

const std::vector<EncodeParams>& codings() {
  static const std::vector<EncodeParams> all{
      params_of(Profile::kExtended, Method::kHmlfc, 0, false),
      params_of(Profile::kExtended, Method::kHmlfc, 0, true),
      params_of(Profile::kExtended, Method::kHmlfc, 2, false),
      params_of(Profile::kExtended, Method::kRlfc, 2, false),
      params_of(Profile::kMain, Method::kHmlfc, 3, false),
      params_of(Profile::kMain, Method::kMc, 0, false)};
  return all;
}

// Parts of single views, of rows, and such that cut groups and clusters.
const std::vector<PartGrid>& divisions() {
  static const std::vector<PartGrid> all{
      {{1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 4, 5}}, {{2, 3, 7}, {5}}, {{4, 7}, {1, 4, 5}}};
  return all;
}

const LightField& field() {
  static const LightField made = test::textured_light_field({7, 5, 45, 38, 8}, 3, 12);
  return made;
}

TEST(Divided, EveryDivisionGivesTheBytesOfTheWhole) {
  const FieldViews views(field());
  for (const EncodeParams& params : codings()) {
    const auto whole = encode(field(), params);
    ASSERT_TRUE(whole.has_value());
    for (const PartGrid& parts : divisions()) {
      MemoryStorage storage;
      auto encoder = DividedEncoder::create(views, params, {{}, parts}, storage);
      ASSERT_TRUE(encoder.has_value()) << encoder.error().message;
      for (size_t part = parts.count(); part-- > 0;) {
        ASSERT_TRUE(encoder->encode_part(part).has_value());
      }
      EXPECT_EQ(stream_of(*encoder), whole->bytes);
      EXPECT_EQ(encoder->error().rgb_squares, whole->error.rgb_squares);
    }
  }
}

// Each part by an encoder of its own, which is made from settled parameters, as on many machines.
TEST(Divided, PartsOfManyEncodersMakeOneStream) {
  const FieldViews views(field());
  for (const EncodeParams& params : codings()) {
    const auto whole = encode(field(), params);
    MemoryStorage storage;
    auto assembled = DividedEncoder::create(views, params, {{}, divisions()[2]}, storage);
    ASSERT_TRUE(assembled.has_value());
    for (size_t part = 0; part < divisions()[2].count(); ++part) {
      MemoryStorage own;
      auto encoder = DividedEncoder::create(views, assembled->params(), {{}, divisions()[2]}, own);
      ASSERT_TRUE(encoder && encoder->encode_part(part));
      const auto bytes = collected([&](const ByteSink& sink) { encoder->save_part(part, sink); });
      EXPECT_FALSE(assembled->load_part(part, std::span(bytes).first(bytes.size() - 1), {}));
      EXPECT_FALSE(assembled->load_part((part + 1) % divisions()[2].count(), bytes, {}));
      ASSERT_TRUE(assembled->load_part(part, bytes, encoder->error()));
    }
    EXPECT_EQ(stream_of(*assembled), whole->bytes);
    EXPECT_EQ(assembled->error().y_squares, whole->error.y_squares);
  }
}

TEST(Divided, MemorySetsThePartsAndTheLeastIsNamed) {
  const FieldViews views(field());
  MemoryStorage storage;
  const auto small = DividedEncoder::create(views, codings()[0], {1000, {}}, storage);
  ASSERT_FALSE(small.has_value());
  EXPECT_NE(small.error().message.find("is the least that would do"), std::string::npos);
  const auto large = DividedEncoder::create(views, codings()[0], {1u << 30, {}}, storage);
  ASSERT_TRUE(large.has_value());
  EXPECT_EQ(large->parts().count(), 1u);
}

}  // namespace
}  // namespace hmlfc
