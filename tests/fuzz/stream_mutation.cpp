// libFuzzer's mutations of streams. CRCs cover most bytes of a stream, and its header has the sizes
// of the sections: a part is changed, then the header is corrected, so that changes reach the code
// after these checks. One change in eight does not correct the header.
#include "stream_mutation.hpp"

#include <algorithm>

#include "stream_parts.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr size_t kMaxGrowth = 64;
constexpr unsigned kPartCount = 6;  // fields of the header and five sections
constexpr size_t kEnvelope = 12;    // magic to header_bytes

// The number of fields after the envelope changes only by level entries.
void mutate_head(std::vector<uint8_t>& head, unsigned seed) {
  if ((seed & 1) != 0) {
    constexpr size_t kLevelEntry = 4;
    constexpr size_t kMinBytes = 48;
    if ((seed & 2) != 0 && head.size() < kMinBytes + 15 * kLevelEntry) {
      head.insert(head.end(), head.end() - kLevelEntry, head.end());
    } else if (head.size() > kMinBytes) {
      head.resize(head.size() - kLevelEntry);
    }
    head[34] = static_cast<uint8_t>((head.size() - kMinBytes) / kLevelEntry);  // tree_height
    return;
  }
  LLVMFuzzerMutate(head.data() + kEnvelope, head.size() - kEnvelope, head.size() - kEnvelope);
}

void mutate_section(std::vector<uint8_t>& section, bool grow) {
  const size_t size = section.size();
  section.resize(std::max<size_t>(size + (grow ? kMaxGrowth : 0), 1));
  section.resize(LLVMFuzzerMutate(section.data(), size, section.size()));
}

}  // namespace

size_t mutate_stream(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  auto parts = split({data, size});
  const unsigned choice = seed >> 8;
  if (!parts || choice % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const unsigned part = (choice / 8) % kPartCount;
  if (part == 0) {
    mutate_head(parts->head, choice / 64);
  } else if (part == 5) {
    if (parts->rig) mutate_section(*parts->rig, (choice / 64) % 4 == 0);
  } else {
    mutate_section(parts->sections[part - 1], (choice / 64) % 4 == 0);
  }
  const std::vector<uint8_t> file = join(*parts);
  if (file.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}

}  // namespace hmlfc::fuzz
