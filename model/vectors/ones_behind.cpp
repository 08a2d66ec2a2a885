#include "vectors/ones_behind.hpp"

#include <cassert>

namespace hmlfc::vectors {
namespace {

constexpr uint64_t kMostBytes = 3;

}  // namespace

void put_ones_behind(FieldRules& rules, uint64_t bits, std::vector<uint8_t>& record,
                     Random& random) {
  if (record.empty() || !rules.has("behind")) return;
  assert((bits + 7) / 8 == record.size());
  if (bits % 8 != 0) record.back() |= static_cast<uint8_t>(0xFF << (bits % 8));
  record.resize(record.size() + rules.pick_unsigned("behind", 0, kMostBytes, random), 0xFF);
}

}  // namespace hmlfc::vectors
