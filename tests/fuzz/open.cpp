// Opens a stream, with and without checking the CRCs of its sections.
#include <hmlfc/decoder.hpp>

#include "stream_parts.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {

void run(std::span<const uint8_t> input) {
  const auto strict = Decoder::open(input);
  const auto lenient = Decoder::open(input, {.check_sections = false});
  demand(lenient || !strict, "a stream opens with its CRCs checked, and not without");
  const bool crc = !strict && strict.error().code == ErrorCode::kBadSectionCrc;
  demand(strict.has_value() == lenient.has_value() || crc, "another error than that of a CRC");
  if (!strict) demand(strict.error().offset <= input.size(), "an error past the end of the file");
}

// The section that opening does not read is cut short.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  auto parts = split(stream);
  if (!parts) return {{stream.begin(), stream.end()}};
  parts->sections[3].resize(std::min<size_t>(parts->sections[3].size(), 64));
  return {{stream.begin(), stream.end()}, join(*parts)};
}

}  // namespace hmlfc::fuzz
