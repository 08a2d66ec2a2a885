#include "chunked_words.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "commands.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kStagingBytes = uint64_t{16} << 20;

}  // namespace

ChunkedWords::ChunkedWords(Device::State& device, uint64_t words)
    : bytes_(4 * std::max<uint64_t>(words, 1)),
      chunk_log2_(static_cast<uint32_t>(std::bit_width(device.chunk_bytes / 4)) - 1) {
  const uint64_t chunk_bytes = uint64_t{4} << chunk_log2_;
  for (uint64_t at = 0; at < bytes_; at += chunk_bytes) {
    chunks_.emplace_back(device, std::min(chunk_bytes, bytes_ - at), Memory::kDevice);
  }
  table_.emplace(device, chunks_.size() * sizeof(uint64_t), Memory::kUpload);
  const auto addresses = table_->records<uint64_t>();
  std::ranges::transform(chunks_, addresses.begin(), [](const Buffer& b) { return b.address(); });
}

void ChunkedWords::upload(Device::State& device, uint64_t at, std::span<const uint8_t> bytes) {
  const uint64_t chunk_bytes = uint64_t{4} << chunk_log2_;
  const Buffer staging(device, std::min<uint64_t>(kStagingBytes, bytes.size()), Memory::kUpload);
  while (!bytes.empty()) {
    const auto part = std::min<size_t>(bytes.size(), kStagingBytes);
    std::memcpy(staging.bytes().data(), bytes.data(), part);
    Commands commands(device);
    for (uint64_t done = 0; done < part;) {
      const uint64_t in_chunk = (at + done) % chunk_bytes;
      // A copy of whole words: the staging buffer and the chunks are padded to them.
      const uint64_t run = std::min(chunk_bytes - in_chunk, part - done);
      commands.copy(staging, done, chunks_[static_cast<size_t>((at + done) / chunk_bytes)],
                    in_chunk, run);
      done += run;
    }
    commands.run();
    at += part;
    bytes = bytes.subspan(part);
  }
}

}  // namespace hmlfc::gpu
