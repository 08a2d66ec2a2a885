// What regions of a stream cost, block by block.
#include <iostream>
#include <memory>
#include <sstream>

#include "common/measuring.hpp"
#include "subcommands.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

// The bytes of ranges that may overlap, ordered by offset.
uint64_t bytes_of(const std::set<std::array<uint64_t, 2>>& ranges) {
  uint64_t bytes = 0;
  uint64_t end = 0;
  for (const auto& [offset, length] : ranges) {
    const uint64_t begin = std::max(offset, end);
    end = std::max(end, offset + length);
    bytes += end - std::min(begin, end);
  }
  return bytes;
}

// A stream that was just opened, and what its requests cost.
class Client {
 public:
  explicit Client(std::span<const uint8_t> file) : decoder_(open_unchecked(file, &reads_)) {}

  Json request(std::istream& rectangles) {
    const uint64_t key_samples = reads_.key_samples();
    reads_.forget_ranges();
    AccessCounts counts;
    ViewPos view;
    Rect rect;
    while (rectangles >> view.row >> view.col >> rect.x >> rect.y >> rect.width >> rect.height) {
      for (const Plane plane : kPlanes) decode(view, plane, rect, counts);
    }
    if (!rectangles.eof()) throw std::invalid_argument("a rectangle has six numbers");
    const uint32_t side = decoder_.header().block_size();
    return {{"bytes", bytes_of(reads_.ranges())},
            {"samples", counts.walks * side * side + reads_.key_samples() - key_samples},
            {"held", reads_.key_samples() * sizeof(int16_t)}};
  }

 private:
  // All blocks of the plane that hold samples of the rectangle of pixels.
  void decode(ViewPos view, Plane plane, const Rect& rect, AccessCounts& counts) {
    const uint32_t halved = decoder_.plane_size(plane).width < decoder_.header().width ? 2 : 1;
    const uint32_t side = decoder_.header().block_size() * halved;  // pixels
    for (uint32_t by = rect.y / side; by * side < rect.y + rect.height; ++by) {
      for (uint32_t bx = rect.x / side; bx * side < rect.x + rect.width; ++bx) {
        value_of(decoder_.decode_block({view, plane, bx, by}, {.counts = &counts}));
      }
    }
  }

  Reads reads_;
  Decoder decoder_;
};

}  // namespace

Json requests(Arguments arguments) {
  const auto file = value_of(io::map_file(arguments[0]));
  const Clock clock;
  value_of(value_of(Decoder::open(file.bytes())).decode_all([](ViewPos, RgbImage&&) {}, {0, 1}));
  Json made{{"decode_seconds", clock.cpu_seconds()}, {"requests", Json::array()}};
  auto client = std::make_unique<Client>(file.bytes());
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty()) {
      client = std::make_unique<Client>(file.bytes());
    } else {
      std::istringstream rectangles(line);
      made["requests"].push_back(client->request(rectangles));
    }
  }
  return made;
}

}  // namespace hmlfc::bench
