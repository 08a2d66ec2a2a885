// Records that the host writes and kernels read lie in memory as the SPIR-V says, and numbers that
// both know are equal.
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "arguments.hpp"
#include "frame_shape.hpp"
#include "stream_shape.hpp"

namespace hmlfc::gpu {
namespace {

struct Fact {
  std::string what;
  std::vector<uint64_t> shader, host;
};

#define MEMBER(record, member, offset, bytes) \
  {#record "." #member, {offset, bytes}, {offsetof(record, member), sizeof(record::member)}},
#define SIZE(record, bytes) {#record, {bytes}, {sizeof(record)}},
#define NUMBER(name, value) {#name, {value}, {uint64_t{name}}},

const std::vector<Fact> kFacts = {
#include "record_layouts.inc"
};

#undef MEMBER
#undef SIZE
#undef NUMBER

std::vector<std::string> differences(const std::vector<Fact>& facts) {
  std::vector<std::string> found;
  for (const Fact& fact : facts) {
    if (fact.shader != fact.host) found.push_back(fact.what);
  }
  return found;
}

TEST(GpuRecords, LieAsTheShadersHaveThem) {
  EXPECT_EQ(differences(kFacts), std::vector<std::string>{});
}

TEST(GpuRecords, AreAllCompared) {
  std::set<std::string> records;
  for (const Fact& fact : kFacts) {
    if (fact.what.find('.') != std::string::npos) {
      records.insert(fact.what.substr(0, fact.what.find('.')));
    }
  }
  EXPECT_EQ(records.size(), 9u);
  EXPECT_GT(kFacts.size(), 120u);
}

// Each number of the shaders, one more than it is.
TEST(GpuRecords, ThatDifferAreNamed) {
  for (size_t i = 0; i < kFacts.size(); ++i) {
    for (size_t k = 0; k < kFacts[i].shader.size(); ++k) {
      auto faulty = kFacts;
      ++faulty[i].shader[k];
      EXPECT_EQ(differences(faulty), std::vector<std::string>{kFacts[i].what});
    }
  }
}

}  // namespace
}  // namespace hmlfc::gpu
