// The same bytes for any number of threads.
#include <gtest/gtest.h>

#include <hmlfc/encoder.hpp>

#include "bits/parallel.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

// 7 threads also on machines with fewer cores.
const ThreadLimit kSevenThreads(7);

TEST(Determinism, BytesDoNotDependOnThreads) {
  const LightField field = test::textured_light_field({5, 7, 61, 43, 8}, 3, 12);
  struct Kind {
    Method method;
    Profile profile;
    int tree_height;
  };
  for (const Kind& kind :
       {Kind{Method::kHmlfc, Profile::kMain, 3}, Kind{Method::kRlfc, Profile::kMain, 3},
        Kind{Method::kMc, Profile::kMain, 0}, Kind{Method::kHmlfc, Profile::kExtended, 0},
        Kind{Method::kHmlfc, Profile::kExtended, 2}, Kind{Method::kRlfc, Profile::kExtended, 2}}) {
    EncodeParams params;
    params.method = kind.method;
    params.profile = kind.profile;
    params.tree_height = kind.tree_height;
    params.threads = 1;
    const auto one = encode(field, params);
    ASSERT_TRUE(one.has_value());
    for (const int threads : {2, 7}) {
      params.threads = threads;
      const auto many = encode(field, params);
      ASSERT_TRUE(many.has_value());
      EXPECT_EQ(one->bytes, many->bytes) << threads << " threads";
    }
  }
}

TEST(Determinism, TargetPsnrDoesNotDependOnThreads) {
  const LightField field = test::textured_light_field({4, 4, 48, 32, 8}, 5, 30);
  EncodeParams params;
  params.profile = Profile::kMain;
  params.chroma = ChromaFormat::k444;
  params.threads = 1;
  const auto one = encode_to(field, params, TargetPsnr{30});
  params.threads = 7;
  const auto many = encode_to(field, params, TargetPsnr{30});
  ASSERT_TRUE(one.has_value() && many.has_value());
  EXPECT_EQ(one->bytes, many->bytes);
  EXPECT_EQ(one->params.main.threshold_pred, many->params.main.threshold_pred);
}

}  // namespace
}  // namespace hmlfc
