// Requests of all kinds at once on one decoder whose caches are empty give what each gives alone.
// In the preset tsan, where loops have plain threads, this is the test for data races in the
// decoder.
#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "bits/parallel.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

const ThreadLimit kFourThreads(4);

// The samples that request `kind` in [0, 4] about `view` gives; none for kind 4.
std::vector<int32_t> request(const Decoder& decoder, size_t kind, ViewPos view) {
  std::vector<int32_t> samples;
  const auto append = [&](const auto& part) {
    samples.insert(samples.end(), part.begin(), part.end());
  };
  BlockOptions options;
  if (kind % 2 == 1) options.references = ReferenceMode::kSparse;
  switch (kind) {
    case 0:
    case 1:
      for (const Plane plane : kPlanes) append(*decoder.decode_block({view, plane, 0, 0}, options));
      break;
    case 2:
      for (const Plane plane : kPlanes) append(*decoder.decode_plane(view, plane));
      break;
    case 3:
      append(decoder.decode_view(view)->samples);
      break;
    default:
      EXPECT_TRUE(decoder.load_references(4).has_value());
  }
  return samples;
}

TEST(Concurrency, RequestsAtOnceGiveWhatEachGivesAlone) {
  constexpr size_t kKinds = 5;
  for (uint32_t seed = 0; seed < 12; ++seed) {
    auto made = test::random_case_of_any_profile(seed);
    made.shape.rows = made.shape.cols = 3;
    const LightField field = test::textured_light_field(made.shape, seed, made.noise);
    const auto encoded = encode(field, made.params);
    ASSERT_TRUE(encoded.has_value());
    const auto alone = Decoder::open(encoded->bytes);
    const auto shared = Decoder::open(encoded->bytes);
    std::vector<std::vector<int32_t>> results(9 * kKinds);
    const auto view = [](size_t i) {
      return ViewPos{static_cast<uint32_t>(i / kKinds / 3), static_cast<uint32_t>(i / kKinds % 3)};
    };
    run_on_threads(4, [&] {
      parallel_for(results.size(),
                   [&](size_t i) { results[i] = request(*shared, i % kKinds, view(i)); });
    });
    for (size_t i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results[i], request(*alone, i % kKinds, view(i))) << "seed " << seed << ", " << i;
    }
  }
}

}  // namespace
}  // namespace hmlfc
