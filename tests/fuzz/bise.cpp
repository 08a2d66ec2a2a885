// Bounded integer sequences at any bit, by both readers (BISE-3 to BISE-11).
#include "arithmetic/bise.hpp"

#include <algorithm>

#include "decoder/fast/bise_unpack.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {
namespace {

// The values survive writing and reading; the sequence has the length of BISE-3.
void check_written(const std::vector<uint32_t>& values, const Levels& levels) {
  BitWriter writer;
  bise_put(writer, levels, values);
  demand(writer.size() == bise_bits(levels, values.size()), "a sequence of the wrong length");
  const BitString bits(writer.bytes());
  for (size_t i = 0; i < values.size(); ++i) {
    demand(bise_value(bits, 0, levels, values.size(), i) == values[i],
           "the values are not those written");
  }
}

}  // namespace

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  const Levels levels = levels_of_code(reader.within(0, kMaxLevelCode));
  const uint32_t count = reader.within(0, 255);
  const uint32_t start = reader.within(0, 63);
  const PaddedRecord record(reader.rest());
  if (!record.bits().holds(start, bise_bits(levels, count))) return;
  std::vector<uint16_t> unpacked(count);
  bise_unpack(record.data(), start, levels, count, unpacked.data());
  std::vector<uint32_t> values;
  for (uint32_t i = 0; i < count; ++i) {
    values.push_back(bise_value(record.bits(), start, levels, count, i));
    demand(values[i] < levels.count, "a value outside its levels");
    demand(values[i] == unpacked[i], "bise_value and bise_unpack differ");
  }
  check_written(values, levels);
}

// The end of a stream has sequences; one seed a stream, with a level code by its size, is enough.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  const auto end = stream.last(std::min<size_t>(stream.size(), 96));
  Bytes bytes{static_cast<uint8_t>(stream.size() % (kMaxLevelCode + 1)), 16, 0};
  bytes.insert(bytes.end(), end.begin(), end.end());
  return {bytes};
}

}  // namespace hmlfc::fuzz
