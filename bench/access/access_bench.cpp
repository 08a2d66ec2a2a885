// What regions of a stream cost, block by block (bench/access/__main__.py runs it).
//
// Usage: bench_access FILE.hmlfc
// Reads lines from its input: an empty line starts anew with a stream just opened; any other is a
// request, rectangles ROW COL X Y WIDTH HEIGHT of views, one after another. Prints JSON: CPU
// seconds of decoding all views on one thread, and for each request the distinct bytes it reads
// without opening the stream, the samples computed (B * B for each walk, and key images whole), and
// the bytes of key images held since the stream was opened.
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/decoder.hpp>

#include "common/program.hpp"
#include "io/files.hpp"
#include "terminal/clock.hpp"

namespace {

using namespace hmlfc;
using bench::value_of;
using Json = nlohmann::ordered_json;

class Reads final : public ReadSink {
 public:
  void on_read(uint64_t offset, uint64_t bytes) override {
    for (uint64_t i = 0; i < bytes; ++i) touched_.insert(offset + i);
  }
  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  uint64_t key_samples() const { return key_samples_; }
  uint64_t take_bytes() { return std::exchange(touched_, {}).size(); }

 private:
  std::set<uint64_t> touched_;
  uint64_t key_samples_ = 0;
};

// A stream that was just opened, and what its requests cost.
class Client {
 public:
  explicit Client(std::span<const uint8_t> file)
      : decoder_(value_of(
            Decoder::open(file, {.check_sections = false, .limits = {}, .reads = &reads_}))) {}

  Json request(std::istream& rectangles) {
    const uint64_t key_samples = reads_.key_samples();
    AccessCounts counts;
    uint64_t row = 0, col = 0;
    Rect rect;
    while (rectangles >> row >> col >> rect.x >> rect.y >> rect.width >> rect.height) {
      for (const Plane plane : kPlanes) decode({row, col}, plane, rect, counts);
    }
    if (!rectangles.eof()) throw std::invalid_argument("a rectangle has six numbers");
    const uint32_t side = decoder_.header().block_size();
    return {{"bytes", reads_.take_bytes()},
            {"samples", counts.walks * side * side + reads_.key_samples() - key_samples},
            {"held", reads_.key_samples() * sizeof(int16_t)}};
  }

 private:
  using Place = std::pair<uint64_t, uint64_t>;

  // All blocks of the plane that hold samples of the rectangle of pixels.
  void decode(const Place& view, Plane plane, const Rect& rect, AccessCounts& counts) {
    const uint32_t halved = decoder_.plane_size(plane).width < decoder_.header().width ? 2 : 1;
    const uint32_t side = decoder_.header().block_size() * halved;  // pixels
    for (uint32_t by = rect.y / side; by * side < rect.y + rect.height; ++by) {
      for (uint32_t bx = rect.x / side; bx * side < rect.x + rect.width; ++bx) {
        const ViewPos place{static_cast<uint32_t>(view.first), static_cast<uint32_t>(view.second)};
        value_of(decoder_.decode_block({place, plane, bx, by}, {.counts = &counts}));
      }
    }
  }

  Reads reads_;
  Decoder decoder_;
};

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 1) throw std::invalid_argument("usage: bench_access FILE.hmlfc");
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
  fmt::print("{}\n", made.dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_access", [&] { return run({argv + 1, argv + argc}); });
}
