#include "exercise.hpp"

#include <algorithm>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::stress {
namespace {

// A place in the stream for people.
std::string place_of(const BlockAddress& block, int level) {
  return "view " + std::to_string(block.view.row) + "," + std::to_string(block.view.col) +
         ", plane " + std::string(plane_name(block.plane)) + ", block " + std::to_string(block.bx) +
         "," + std::to_string(block.by) + ", level " + std::to_string(level);
}

class Exercise {
 public:
  Exercise(const Decoder& decoder, uint64_t most_blocks)
      : decoder_(decoder), header_(decoder.header()), most_blocks_(most_blocks) {}

  Outcome run() {
    const uint64_t sites = count_sites();
    const uint64_t stride = std::max<uint64_t>(1, sites / std::max<uint64_t>(1, most_blocks_));
    for (uint64_t site = 0; site < sites && outcome_.failure.empty(); site += stride) {
      decode_site(site);
    }
    if (outcome_.failure.empty()) decode_views();
    outcome_.ranges = take_ranges();
    return outcome_;
  }

 private:
  uint64_t blocks_of(Plane plane) const {
    const PlaneSize size = decoder_.plane_size(plane);
    const uint64_t side = header_.block_size();
    return ((size.width + side - 1) / side) * ((size.height + side - 1) / side);
  }

  uint64_t blocks_of_view() const {
    return blocks_of(Plane::kY) + blocks_of(Plane::kCo) + blocks_of(Plane::kCg);
  }

  uint64_t count_sites() const { return uint64_t{header_.rows} * header_.cols * blocks_of_view(); }

  BlockAddress site_at(uint64_t site) const {
    const uint64_t view = site / blocks_of_view();
    uint64_t block = site % blocks_of_view();
    BlockAddress address;
    address.view = {static_cast<uint32_t>(view / header_.cols),
                    static_cast<uint32_t>(view % header_.cols)};
    for (const Plane plane : kPlanes) {
      address.plane = plane;
      if (block < blocks_of(plane)) break;
      block -= blocks_of(plane);
    }
    const PlaneSize size = decoder_.plane_size(address.plane);
    const uint64_t across = (size.width + header_.block_size() - 1) / header_.block_size();
    address.bx = static_cast<uint32_t>(block % across);
    address.by = static_cast<uint32_t>(block / across);
    return address;
  }

  void decode_site(uint64_t site) {
    const BlockAddress address = site_at(site);
    const int levels = header_.tree_height + 1;
    const bool above =
        outcome_.blocks % 4 == 0;  // each fourth block at one stop level after another
    const int level =
        above ? static_cast<int>(outcome_.blocks / 4 % static_cast<uint64_t>(levels)) : 0;
    const auto samples = decoder_.decode_block(address, {.stop_level = level});
    ++outcome_.blocks;
    const auto kept =
        decoder_.decode_block(address, {.stop_level = level, .references = ReferenceMode::kSparse});
    note(address, level, samples.has_value() == kept.has_value() && (!samples || *samples == *kept),
         "reference images on demand and kept give different blocks");
    if (samples) compare_with_plane(address, level, *samples);
  }

  void compare_with_plane(const BlockAddress& address, int level,
                          const std::vector<int32_t>& samples) {
    const uint32_t side = header_.block_size();
    const PlaneSize size = decoder_.plane_size(address.plane);
    const Rect rect{address.bx * side, address.by * side,
                    std::min(side, size.width - address.bx * side),
                    std::min(side, size.height - address.by * side)};
    const auto fast = decoder_.decode_rect(address.view, address.plane, rect, level);
    bool same = fast.has_value();
    for (uint32_t y = 0; same && y < rect.height; ++y) {
      const auto row = fast->begin() + static_cast<std::ptrdiff_t>(size_t{y} * rect.width);
      same = std::equal(row, row + rect.width,
                        samples.begin() + static_cast<std::ptrdiff_t>(size_t{y} * side));
    }
    note(address, level, same, "a block and its rectangle differ");
  }

  void note(const BlockAddress& address, int level, bool good, const char* what) {
    const auto violation = take_violation();
    if (!outcome_.failure.empty() || (good && !violation)) return;
    outcome_.failure =
        (violation ? *violation : std::string(what)) + "; " + place_of(address, level);
  }

  void decode_views() {
    const auto ignore = [](ViewPos, RgbImage&&) {};
    for (int level = 0; level <= header_.tree_height; ++level) {
      static_cast<void>(decoder_.decode_all(ignore, {.stop_level = level, .threads = 1}));
      if (const auto violation = take_violation()) {
        outcome_.failure = *violation + "; all views, level " + std::to_string(level);
        return;
      }
    }
  }

  const Decoder& decoder_;
  const StreamHeader& header_;
  uint64_t most_blocks_;
  Outcome outcome_;
};

}  // namespace

Outcome exercise(std::span<const uint8_t> file, uint64_t most_blocks) {
  const auto decoder = Decoder::open(file, {.check_sections = false});
  if (decoder) return Exercise(*decoder, most_blocks).run();
  Outcome outcome;
  if (const auto violation = take_violation()) outcome.failure = *violation + "; opening";
  outcome.ranges = take_ranges();
  return outcome;
}

}  // namespace hmlfc::stress
