#include "session.hpp"

#include <algorithm>
#include <fstream>

#include <hmlfc/decoder.hpp>

namespace hmlfc::stress {
namespace {

void write_file(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

// The result of one stream.
struct Outcome {
  Ranges ranges;
  uint64_t blocks = 0;  // decoded one by one
  std::string failure;  // what is wrong and where; empty: nothing
};

// A place in the stream, as text.
std::string place_of(const BlockAddress& block, int level) {
  return "view " + std::to_string(block.view.row) + "," + std::to_string(block.view.col) +
         ", plane " + std::string(plane_name(block.plane)) + ", block " + std::to_string(block.bx) +
         "," + std::to_string(block.by) + ", level " + std::to_string(level);
}

class Exercise {
 public:
  Exercise(const Decoder& decoder, uint64_t max_blocks)
      : decoder_(decoder), header_(decoder.header()), max_blocks_(max_blocks) {}

  Outcome run() {
    uint64_t sites = 0;
    for_each_block([&](const BlockAddress&) { ++sites; });
    const uint64_t stride = std::max<uint64_t>(1, sites / std::max<uint64_t>(1, max_blocks_));
    uint64_t site = 0;
    for_each_block([&](const BlockAddress& address) {
      if (site++ % stride == 0 && outcome_.failure.empty()) decode_block(address);
    });
    if (outcome_.failure.empty()) decode_views();
    outcome_.ranges = take_ranges();
    return outcome_;
  }

 private:
  // View by view, plane by plane, row by row.
  template <class Take>
  void for_each_block(const Take& take) const {
    const uint32_t side = header_.block_size();
    for (uint32_t view = 0; view < header_.rows * header_.cols; ++view) {
      for (const Plane plane : kPlanes) {
        const PlaneSize size = decoder_.plane_size(plane);
        for (uint32_t by = 0; by * side < size.height; ++by) {
          for (uint32_t bx = 0; bx * side < size.width; ++bx) {
            take(BlockAddress{{view / header_.cols, view % header_.cols}, plane, bx, by});
          }
        }
      }
    }
  }

  void decode_block(const BlockAddress& address) {
    // Every fourth block at the next stop level, the others at level 0.
    const uint64_t turn = outcome_.blocks / 4 % static_cast<uint64_t>(header_.tree_height + 1);
    const int level = outcome_.blocks % 4 == 0 ? static_cast<int>(turn) : 0;
    const uint32_t side = header_.block_size();
    const PlaneSize size = decoder_.plane_size(address.plane);
    const Rect rect{address.bx * side, address.by * side,
                    std::min(side, size.width - address.bx * side),
                    std::min(side, size.height - address.by * side)};
    for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
      static_cast<void>(decoder_.decode_block(address, {.stop_level = level, .references = mode}));
    }
    static_cast<void>(decoder_.decode_rect(address.view, address.plane, rect, level));
    ++outcome_.blocks;
    if (const auto violation = take_violation()) {
      outcome_.failure = *violation + "; " + place_of(address, level);
    }
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
  uint64_t max_blocks_;
  Outcome outcome_;
};

Outcome exercise(std::span<const uint8_t> file, uint64_t max_blocks) {
  const auto decoder = Decoder::open(file, {.check_sections = false});
  if (decoder) return Exercise(*decoder, max_blocks).run();
  Outcome outcome;
  if (const auto violation = take_violation()) outcome.failure = *violation + "; opening";
  outcome.ranges = take_ranges();
  return outcome;
}

}  // namespace

Ranges Session::run(const std::string& name, std::span<const uint8_t> file) {
  write_file(folder_ / "current.hmlfc", file);
  std::ofstream(folder_ / "current.txt") << name << '\n';
  const Outcome outcome = exercise(file, max_blocks_);
  ++streams_;
  blocks_ += outcome.blocks;
  if (!outcome.failure.empty()) {
    const auto stored = folder_ / ("finding-" + std::to_string(findings_.size()) + ".hmlfc");
    write_file(stored, file);
    findings_.push_back({{"stream", name}, {"what", outcome.failure}, {"stored", stored.string()}});
  }
  widths_.add(name, outcome.ranges);
  return outcome.ranges;
}

void Session::add(const std::string& name, const Ranges& ranges) {
  widths_.add(name, ranges);
  if (const auto violation = take_violation()) {
    findings_.push_back({{"stream", name}, {"what", *violation}, {"stored", ""}});
  }
}

vectors::Json Session::report() const {
  return {{"streams", streams_},
          {"blocks", blocks_},
          {"findings", findings_},
          {"rows", widths_.rows()}};
}

}  // namespace hmlfc::stress
