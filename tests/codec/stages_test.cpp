// DEC-3 on the streams of the encoder: each stage that a decoder reports follows from those before.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

using Values = std::vector<int32_t>;

struct Counts {
  int predictions = 0;
  int clamped_predictions = 0;
};

// Checks the stages of each level as its last one, "sample", arrives.
class StageCheck final : public TraceSink {
 public:
  StageCheck(int depth, Plane plane, Counts& counts)
      : lo_(plane == Plane::kY ? 0 : 1 - (1 << depth)), hi_((1 << depth) - 1), counts_(counts) {}

  void on_field(const FieldRecord&) override {}

  void on_stage(const StageRecord& record) override {
    stages_[std::string(record.stage)] = Values(record.values.begin(), record.values.end());
    if (record.stage != "sample") return;
    if (stages_.contains("parent")) check();
    stages_.clear();
  }

 private:
  int32_t clamped(int32_t value) const { return std::clamp(value, lo_, hi_); }

  void check() {
    const Values& parent = stages_["parent"];
    const Values& prediction = stages_["prediction"];
    if (stages_.contains("reference")) {
      const bool plus = check_prediction(1);
      EXPECT_TRUE(plus || check_prediction(-1));
    } else {
      EXPECT_EQ(prediction, parent);
    }
    Values sample = prediction;
    if (stages_.contains("residual")) {
      const Values& residual = stages_["residual"];
      for (size_t i = 0; i < sample.size(); ++i) sample[i] = clamped(sample[i] + residual[i]);
    }
    EXPECT_EQ(sample, stages_["sample"]);
  }

  // Whether parent + sign * reference is the prediction.
  bool check_prediction(int32_t sign) {
    bool needs_clamp = false;
    Values expected = stages_["parent"];
    for (size_t i = 0; i < expected.size(); ++i) {
      const int32_t sum = expected[i] + sign * stages_["reference"][i];
      expected[i] = clamped(sum);
      needs_clamp |= sum != expected[i];
    }
    if (expected != stages_["prediction"]) return false;
    ++counts_.predictions;
    counts_.clamped_predictions += needs_clamp;
    return true;
  }

  int32_t lo_;
  int32_t hi_;
  Counts& counts_;
  std::map<std::string, Values> stages_;
};

TEST(Stages, EachFollowsFromThoseBefore) {
  Counts counts;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    auto made = test::random_case(seed);
    made.params.main.threshold_ref /= 8;
    made.params.main.threshold_pred /= 8;
    const LightField field = test::textured_light_field(made.shape, seed, made.noise);
    const auto encoded = encode(field, made.params);
    const auto decoder = Decoder::open(encoded->bytes);
    const StreamHeader& header = decoder->header();
    test::Random random(seed);
    for (int block = 0; block < 200; ++block) {
      const Plane plane = kPlanes[random() % 3];
      const PlaneSize size = decoder->plane_size(plane);
      StageCheck check(header.depth, plane, counts);
      const BlockAddress address{{random() % header.rows, random() % header.cols},
                                 plane,
                                 random() % size.width / header.block_size(),
                                 random() % size.height / header.block_size()};
      ASSERT_TRUE(decoder->decode_block(address, {.trace = &check}).has_value());
    }
  }
  // The streams contained every case of the rules.
  EXPECT_GT(counts.predictions, 500);
  EXPECT_GT(counts.clamped_predictions, 50);
}

}  // namespace
}  // namespace hmlfc
