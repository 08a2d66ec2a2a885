// The whole path of a block: opens a stream and decodes single blocks, with reference images on
// demand and kept, and as part of a plane.
#include <hmlfc/decoder.hpp>

#include "bits/crc32c.hpp"
#include "target.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr uint64_t kMaxSamples = 1u << 14;  // of a view
constexpr unsigned kBlocks = 8;             // of one input

// Random numbers that depend on the input alone, so that a finding can be repeated.
class InputRandom {
 public:
  explicit InputRandom(std::span<const uint8_t> input) : state_(crc32c(input)) {}
  uint32_t below(uint32_t count) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>(state_ >> 33) % count;
  }

 private:
  uint64_t state_;
};

void check_rect(const Decoder& decoder, const BlockAddress& block, int level,
                const Result<std::vector<int32_t>>& golden) {
  const uint32_t side = decoder.header().block_size();
  const PlaneSize size = decoder.plane_size(block.plane);
  const Rect rect{block.bx * side, block.by * side, std::min(side, size.width - block.bx * side),
                  std::min(side, size.height - block.by * side)};
  const auto samples = decoder.decode_rect(block.view, block.plane, rect, level);
  demand(samples.has_value() == golden.has_value(), "a block decodes by one path only");
  if (!golden) return;
  for (uint32_t y = 0; y < rect.height; ++y) {
    for (uint32_t x = 0; x < rect.width; ++x) {
      demand((*samples)[y * rect.width + x] == (*golden)[y * side + x],
             "two paths give different samples");
    }
  }
}

void decode_some_block(const Decoder& decoder, size_t file_size, InputRandom& random) {
  const StreamHeader& header = decoder.header();
  BlockAddress block;
  block.plane = kPlanes[random.below(kPlaneCount)];
  block.view = {random.below(header.rows), random.below(header.cols)};
  const PlaneSize size = decoder.plane_size(block.plane);
  const uint32_t side = header.block_size();
  block.bx = random.below((size.width + side - 1) / side);
  block.by = random.below((size.height + side - 1) / side);
  const int levels = header.tree_height + 1;
  const int level = random.below(2) == 0 ? 0 : static_cast<int>(random.below(uint32_t(levels)));
  const auto golden = decoder.decode_block(block, {.stop_level = level});
  if (!golden) demand(golden.error().offset <= file_size, "an error past the end of the file");
  const auto sparse =
      decoder.decode_block(block, {.stop_level = level, .references = ReferenceMode::kSparse});
  if (golden && sparse) demand(*golden == *sparse, "reference images that are kept differ");
  check_rect(decoder, block, level, golden);
}

}  // namespace

void run(std::span<const uint8_t> input) {
  OpenOptions options;
  options.check_sections = false;
  options.limits.max_plane_samples = kMaxSamples;
  const auto decoder = Decoder::open(input, options);
  if (!decoder) return;
  InputRandom random(input);
  for (unsigned i = 0; i < kBlocks; ++i) decode_some_block(*decoder, input.size(), random);
}

std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  return {{stream.begin(), stream.end()}};
}

}  // namespace hmlfc::fuzz
