// All trit and quint codes (BISE-8, BISE-9, BISE-10).
#include "arithmetic/bise.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/naive_bise.hpp"

namespace hmlfc {
namespace {

using Digits = std::vector<uint32_t>;

template <size_t kMembers>
Digits as_digits(const std::array<uint8_t, kMembers>& digits) {
  return {digits.begin(), digits.end()};
}

Trits as_trits(const Digits& digits) {
  Trits trits{};
  for (size_t i = 0; i < trits.size(); ++i) trits[i] = static_cast<uint8_t>(digits[i]);
  return trits;
}

Quints as_quints(const Digits& digits) {
  Quints quints{};
  for (size_t i = 0; i < quints.size(); ++i) quints[i] = static_cast<uint8_t>(digits[i]);
  return quints;
}

// All codes of each digit tuple, ascending, by the formula of the specification.
std::map<Digits, std::vector<unsigned>> all_trit_codes() {
  std::map<Digits, std::vector<unsigned>> codes;
  for (unsigned T = 0; T < 256; ++T) codes[test::naive_trits(T)].push_back(T);
  return codes;
}

std::map<Digits, std::vector<unsigned>> all_quint_codes() {
  std::map<Digits, std::vector<unsigned>> codes;
  for (unsigned Q = 0; Q < 128; ++Q) codes[test::naive_quints(Q)].push_back(Q);
  return codes;
}

TEST(BiseDigits, AllTritCodes) {
  for (unsigned T = 0; T < 256; ++T) {
    EXPECT_EQ(as_digits(trits_of_code(T)), test::naive_trits(T)) << T;
  }
}

TEST(BiseDigits, AllQuintCodes) {
  for (unsigned Q = 0; Q < 128; ++Q) {
    EXPECT_EQ(as_digits(quints_of_code(Q)), test::naive_quints(Q)) << Q;
  }
}

TEST(BiseDigits, EveryTritTupleHasItsGreatestCode) {
  const auto codes = all_trit_codes();
  EXPECT_EQ(codes.size(), 243u);
  for (const auto& [digits, all] : codes) {
    EXPECT_EQ(canonical_trit_code(as_trits(digits)), all.back());
  }
}

TEST(BiseDigits, EveryQuintTupleHasItsGreatestCode) {
  const auto codes = all_quint_codes();
  EXPECT_EQ(codes.size(), 125u);
  for (const auto& [digits, all] : codes) {
    EXPECT_EQ(canonical_quint_code(as_quints(digits)), all.back());
  }
}

// BISE-10 counts them; which ones they are is what two well-known ASTC encoders write.
TEST(BiseDigits, ThirteenTritTuplesHaveTwoCodes) {
  std::vector<unsigned> greatest;
  for (const auto& [digits, all] : all_trit_codes()) {
    ASSERT_LE(all.size(), 2u);
    if (all.size() == 1) continue;
    greatest.push_back(all.back());
    for (const unsigned T : all) EXPECT_EQ(as_digits(trits_of_code(T)), digits) << T;
    EXPECT_NE(all.front(), canonical_trit_code(as_trits(digits)));
  }
  std::sort(greatest.begin(), greatest.end());
  EXPECT_EQ(greatest,
            (std::vector<unsigned>{15, 47, 79, 111, 127, 143, 175, 207, 239, 252, 253, 254, 255}));
}

TEST(BiseDigits, TheQuintTuple444HasFourCodes) {
  for (const auto& [digits, all] : all_quint_codes()) {
    if (digits == Digits{4, 4, 4}) {
      EXPECT_EQ(all, (std::vector<unsigned>{7, 15, 23, 31}));
      for (const unsigned Q : all) EXPECT_EQ(as_digits(quints_of_code(Q)), digits) << Q;
      EXPECT_EQ(canonical_quint_code({4, 4, 4}), 31);
    } else {
      EXPECT_EQ(all.size(), 1u);
    }
  }
}

}  // namespace
}  // namespace hmlfc
