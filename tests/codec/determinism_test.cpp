// The encoder writes the same bytes with any number of threads.
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

}  // namespace
}  // namespace hmlfc
