// All trit and quint codes: how many stand for each tuple of digits, and which of them is written
// (BISE-8 to BISE-10). Which digits a code stands for, the vectors and the decoder in Python say.
#include "arithmetic/bise.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

/// The codes in [0, count - 1] of each digit tuple, ascending.
template <class Digits>
std::map<Digits, std::vector<unsigned>> codes_of(Digits (*digits)(uint32_t), unsigned count) {
  std::map<Digits, std::vector<unsigned>> codes;
  for (unsigned code = 0; code < count; ++code) codes[digits(code)].push_back(code);
  return codes;
}

// BISE-10 counts the tuples of two codes; which ones they are is what two well-known ASTC encoders
// write.
TEST(BiseDigits, ThirteenTritTuplesHaveTwoCodes) {
  const auto codes = codes_of(trits_of_code, 256);
  EXPECT_EQ(codes.size(), 243u);
  std::vector<unsigned> greatest;
  for (const auto& [digits, all] : codes) {
    EXPECT_EQ(canonical_trit_code(digits), all.back());
    ASSERT_LE(all.size(), 2u);
    if (all.size() == 2) greatest.push_back(all.back());
  }
  std::sort(greatest.begin(), greatest.end());
  EXPECT_EQ(greatest,
            (std::vector<unsigned>{15, 47, 79, 111, 127, 143, 175, 207, 239, 252, 253, 254, 255}));
}

TEST(BiseDigits, TheQuintTuple444HasFourCodes) {
  const auto codes = codes_of(quints_of_code, 128);
  EXPECT_EQ(codes.size(), 125u);
  for (const auto& [digits, all] : codes) {
    EXPECT_EQ(canonical_quint_code(digits), all.back());
    const bool redundant = digits == Quints{4, 4, 4};
    EXPECT_EQ(all.size(), redundant ? 4u : 1u);
    if (redundant) {
      EXPECT_EQ(all, (std::vector<unsigned>{7, 15, 23, 31}));
    }
  }
}

}  // namespace
}  // namespace hmlfc
