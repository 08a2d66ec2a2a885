#include "arithmetic/bise_digits.hpp"

namespace hmlfc {
namespace {

constexpr size_t index_of(const Trits& t) {
  return t[0] + 3u * (t[1] + 3u * (t[2] + 3u * (t[3] + 3u * t[4])));
}

constexpr size_t index_of(const Quints& q) { return q[0] + 5u * (q[1] + 5u * q[2]); }

// Codes are entered in ascending order, so that the greatest code of each tuple stays.
constexpr std::array<uint8_t, 243> make_trit_codes() {
  std::array<uint8_t, 243> codes{};
  for (uint32_t T = 0; T < 256; ++T) codes[index_of(trits_of_code(T))] = static_cast<uint8_t>(T);
  return codes;
}

constexpr std::array<uint8_t, 125> make_quint_codes() {
  std::array<uint8_t, 125> codes{};
  for (uint32_t Q = 0; Q < 128; ++Q) codes[index_of(quints_of_code(Q))] = static_cast<uint8_t>(Q);
  return codes;
}

constexpr auto kTritCodes = make_trit_codes();
constexpr auto kQuintCodes = make_quint_codes();

}  // namespace

uint8_t canonical_trit_code(const Trits& trits) { return kTritCodes[index_of(trits)]; }

uint8_t canonical_quint_code(const Quints& quints) { return kQuintCodes[index_of(quints)]; }

}  // namespace hmlfc
