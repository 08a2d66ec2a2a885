#include "arithmetic/naive_bise.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace hmlfc::test {
namespace {

using Letters = std::map<char, unsigned>;

// Matches `bits`, written most significant first, with a pattern of the same length: 0 and 1 stand
// for themselves, a dot for any bit, a letter for a bit to remember.
bool matches(const std::string& bits, std::string_view pattern, Letters& letters) {
  letters.clear();
  for (size_t i = 0; i < bits.size(); ++i) {
    const char want = pattern[i];
    if (want == '0' || want == '1') {
      if (bits[i] != want) return false;
    } else if (want != '.') {
      letters[want] = bits[i] == '1' ? 1 : 0;
    }
  }
  return true;
}

// Reads a word such as "ab", "2" or "A" (the opposite of bit a) as bits joined, or as one number.
unsigned value_of(std::string_view word, const Letters& letters) {
  if (word[0] >= '2' && word[0] <= '4') return static_cast<unsigned>(word[0] - '0');
  unsigned value = 0;
  for (const char letter : word) {
    const bool opposite = letter >= 'A' && letter <= 'Z';
    const unsigned bit =
        opposite ? 1 - letters.at(static_cast<char>(letter - 'A' + 'a')) : letters.at(letter);
    value = 2 * value + bit;
  }
  return value;
}

std::string binary(unsigned value, unsigned length) {
  std::string text;
  for (unsigned i = length; i-- > 0;) text += (value >> i) % 2 != 0 ? '1' : '0';
  return text;
}

// A pattern and what its letters make; the first that matches counts. An empty `inner` means that
// all digits are given.
struct Rule {
  std::string_view pattern;
  std::string_view inner;
  std::vector<std::string_view> digits;
};

const std::vector<Rule> kTrits{{"abc111de", "abcde", {"2", "2"}},  // C, t3, t4
                               {"a11bcdef", "bcdef", {"a", "2"}},
                               {"abcdefgh", "defgh", {"bc", "a"}}};
const std::vector<Rule> kInnerTrits{{"a1.11", "", {"2", "a", "2"}},  // t0, t1, t2
                                    {"a0b11", "", {"b", "a", "2"}},
                                    {".11ab", "", {"ab", "2", "2"}},
                                    {"abc1.", "", {"2", "bc", "a"}},
                                    {"abc0d", "", {"d", "bc", "a"}}};
const std::vector<Rule> kQuints{{"00..111", "", {"4", "4", "4"}},  // C, q2, or all
                                {"00ab110", "", {"4", "4", "ab"}},
                                {"abcd11e", "cdABe", {"4"}},
                                {"abcdefg", "cdefg", {"ab"}}};
const std::vector<Rule> kInnerQuints{{"ab101", "", {"ab", "4"}},  // q0, q1
                                     {"abcde", "", {"cde", "ab"}}};

std::vector<uint32_t> digits_of(const std::string& bits, const std::vector<Rule>& rules,
                                const std::vector<Rule>& inner_rules) {
  Letters letters;
  for (const Rule& rule : rules) {
    if (!matches(bits, rule.pattern, letters)) continue;
    std::vector<uint32_t> digits;
    if (!rule.inner.empty()) {
      std::string inner;
      for (const char letter : rule.inner) {
        inner += value_of(std::string_view(&letter, 1), letters) == 1 ? '1' : '0';
      }
      digits = digits_of(inner, inner_rules, {});
    }
    for (const std::string_view word : rule.digits) digits.push_back(value_of(word, letters));
    return digits;
  }
  return {};
}

// N = base * 2^plain_bits with base 1, 3 or 5, and the order of a group's bits (BISE-5, BISE-6): m
// stands for a value's plain bits, d for one more bit of its group's code.
struct Form {
  unsigned base = 0;
  unsigned plain_bits = 0;
  std::string_view group;
};

Form form_of(uint32_t N) {
  for (unsigned n = 0; n < 32; ++n) {
    if (N == uint64_t{1} << n) return {1, n, "m"};
    if (N == uint64_t{3} << n) return {3, n, "mddmddmdmddmd"};
    if (N == uint64_t{5} << n) return {5, n, "mdddmddmdd"};
  }
  return {};
}

}  // namespace

std::vector<uint32_t> naive_level_counts() {
  std::vector<uint32_t> counts;
  for (const uint32_t base : {1u, 3u, 5u}) {
    for (uint32_t N = base; N <= 16384; N *= 2) counts.push_back(N);
  }
  std::sort(counts.begin(), counts.end());
  return counts;
}

std::vector<uint32_t> naive_trits(unsigned T) {
  return digits_of(binary(T, 8), kTrits, kInnerTrits);
}

std::vector<uint32_t> naive_quints(unsigned Q) {
  return digits_of(binary(Q, 7), kQuints, kInnerQuints);
}

unsigned naive_greatest_code(const std::vector<uint32_t>& digits) {
  static const auto codes = [] {
    std::map<std::vector<uint32_t>, unsigned> greatest;
    for (unsigned T = 0; T < 256; ++T) greatest[naive_trits(T)] = T;
    for (unsigned Q = 0; Q < 128; ++Q) greatest[naive_quints(Q)] = Q;
    return greatest;
  }();
  return codes.at(digits);
}

uint64_t naive_bise_bits(uint32_t N, uint64_t count) {
  const Form form = form_of(N);
  uint64_t digit_bits = 0;
  while (form.base == 3 && 5 * digit_bits < 8 * count) ++digit_bits;
  while (form.base == 5 && 3 * digit_bits < 7 * count) ++digit_bits;
  return form.plain_bits * count + digit_bits;
}

std::vector<uint32_t> naive_bise_decode(const NaiveBits& bits, size_t start, uint32_t N,
                                        size_t count) {
  const Form form = form_of(N);
  const size_t end = start + naive_bise_bits(N, count);
  std::vector<uint32_t> values;
  size_t at = start;
  while (values.size() < count) {
    std::vector<uint32_t> plain;
    unsigned code = 0;
    unsigned code_bit = 0;
    for (const char kind : form.group) {
      if (kind == 'm') {
        plain.push_back(static_cast<uint32_t>(bits.field(at, form.plain_bits)));
        at += form.plain_bits;
      } else {
        if (at < end && bits[at]) code += 1u << code_bit;
        ++code_bit;
        ++at;
      }
    }
    std::vector<uint32_t> digits{0};
    if (form.base == 3) digits = naive_trits(code);
    if (form.base == 5) digits = naive_quints(code);
    for (size_t j = 0; j < plain.size() && values.size() < count; ++j) {
      values.push_back(digits[j] * (1u << form.plain_bits) + plain[j]);
    }
  }
  return values;
}

void naive_bise_encode(NaiveBits& bits, uint32_t N, const std::vector<uint32_t>& values) {
  const Form form = form_of(N);
  const size_t end = bits.size() + naive_bise_bits(N, values.size());
  const size_t members = form.base == 3 ? 5 : form.base == 5 ? 3 : 1;
  for (size_t first = 0; first < values.size(); first += members) {
    std::vector<uint32_t> digits(members);
    for (size_t j = 0; j < members && first + j < values.size(); ++j) {
      digits[j] = values[first + j] >> form.plain_bits;
    }
    unsigned code = form.base == 1 ? 0 : naive_greatest_code(digits);
    size_t member = first;
    for (const char kind : form.group) {
      if (bits.size() == end) break;
      if (kind == 'm') {
        bits.put(values[member++], form.plain_bits);
      } else {
        bits.put(code % 2, 1);
        code /= 2;
      }
    }
  }
}

}  // namespace hmlfc::test
