#include "vectors/ones_behind.hpp"

namespace hmlfc::vectors {
namespace {

constexpr uint64_t kMostBytes = 3;

}  // namespace

void append_ones(FieldRules& rules, std::vector<uint8_t>& record, Random& random) {
  if (record.empty() || !rules.has("behind")) return;
  record.resize(record.size() + rules.pick_unsigned("behind", 0, kMostBytes, random), 0xFF);
}

std::vector<uint8_t> with_ones_behind(FieldRules& rules, BitWriter& writer, Random& random) {
  const auto rest = static_cast<unsigned>((8 - writer.size() % 8) % 8);
  if (rules.has("behind")) writer.put((1u << rest) - 1, rest);
  std::vector<uint8_t> record = writer.take();
  append_ones(rules, record, random);
  return record;
}

}  // namespace hmlfc::vectors
