// The mutator of target view: changes the request or its stream.
#include <algorithm>
#include <limits>

#include "page_input.hpp"
#include "stream_mutation.hpp"

namespace {

using hmlfc::fuzz::Bytes;

constexpr size_t kMaxGrowth = 256;

Bytes mutated(std::span<const uint8_t> bytes, unsigned seed, bool stream) {
  Bytes changed(bytes.begin(), bytes.end());
  changed.resize(std::max<size_t>(bytes.size() + kMaxGrowth, 1));
  changed.resize(
      stream ? hmlfc::fuzz::mutate_stream(changed.data(), bytes.size(), changed.size(), seed)
             : LLVMFuzzerMutate(changed.data(), bytes.size(), changed.size()));
  return changed;
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  using hmlfc::fuzz::PageInput;
  PageInput page = PageInput::of({data, size});
  const bool stream = seed % 4 == 0;
  std::span<const uint8_t>& part = stream ? page.stream : page.request;
  const Bytes changed = mutated(part, seed / 4, stream);
  part = changed;
  if (page.request.size() > std::numeric_limits<uint16_t>::max()) return size;
  const Bytes all = page.bytes();
  if (all.size() > max_size) return size;
  std::copy(all.begin(), all.end(), data);
  return all.size();
}
