#include "view/plane_trace.hpp"

#include <algorithm>
#include <mutex>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "bits/parallel.hpp"
#include "cli/block_report.hpp"

namespace hmlfc::view {

namespace {

uint32_t bits_read(const cli::TracedLevel& level) {
  uint32_t bits = 0;
  for (const cli::TracedWalk& walk : level.walks) {
    if (level.is_reference(walk)) continue;
    for (const FieldRecord& field : walk.fields) bits += field.bits;
  }
  return bits;
}

// Bits of the last field of this name.
uint32_t bits_of_last(const cli::TracedWalk& walk, std::string_view name) {
  const auto found = std::find_if(walk.fields.rbegin(), walk.fields.rend(),
                                  [name](const FieldRecord& field) { return field.name == name; });
  return found == walk.fields.rend() ? 0 : found->bits;
}

uint32_t bits_alone(const cli::TracedLevel& level, size_t samples) {
  uint32_t bits = 0;
  if (const cli::TracedWalk* motion = level.walk(TileKind::kMotion)) {
    bits += bits_of_last(*motion, "index");
  }
  const cli::TracedWalk* own = level.own_walk();
  if (own == nullptr) return bits;
  for (const std::string_view name : {"sign", "dx", "dy"}) bits += bits_of_last(*own, name);
  const auto code = own->level_code();
  if (level.stage("residual") == nullptr || !code) return bits;
  for (const std::string_view name : {"level_delta", "step_delta", "bias"}) {
    bits += bits_of_last(*own, name);
  }
  return bits + static_cast<uint32_t>(bise_bits(levels_of_code(*code), samples));
}

// Fills a PlaneTrace, one row of blocks a thread.
class Tracer {
 public:
  Tracer(const Decoder& decoder, ViewPos view, Plane plane, int stop_level)
      : decoder_(decoder), view_(view), plane_(plane), stop_level_(stop_level) {
    const uint32_t side = decoder.header().block_size();
    made_.size = decoder.plane_size(plane);
    made_.columns = (made_.size.width + side - 1) / side;
    made_.rows = (made_.size.height + side - 1) / side;
    const size_t samples = size_t{made_.size.width} * made_.size.height;
    for (auto& stage : made_.stages) stage.assign(samples, kNoSample);
    const size_t blocks = size_t{made_.columns} * made_.rows;
    made_.states.assign(blocks, kCorruptBlock);
    for (auto* numbers : {&made_.bits, &made_.read, &made_.level_counts, &made_.steps}) {
      numbers->assign(blocks, 0);
    }
  }

  PlaneTrace run() {
    parallel_for(made_.rows, [this](size_t by) {
      for (uint32_t bx = 0; bx < made_.columns; ++bx) trace(bx, static_cast<uint32_t>(by));
    });
    std::ranges::stable_sort(made_.vectors, {}, &PlaneVector::block);
    std::ranges::sort(made_.errors, {}, &PlaneError::block);
    return std::move(made_);
  }

 private:
  void trace(uint32_t bx, uint32_t by) {
    cli::BlockTrace trace;
    const BlockOptions options{
        .stop_level = stop_level_, .trace = &trace, .references = ReferenceMode::kSparse};
    const auto block = decoder_.decode_block({view_, plane_, bx, by}, options);
    const uint32_t at = by * made_.columns + bx;
    if (!block) {
      const std::lock_guard lock(mutex_);
      made_.errors.push_back({at, to_string(block.error())});
      return;
    }
    const cli::TracedLevel& level = trace.levels().back();
    copy_stages(level, bx, by);
    const cli::TracedWalk* own = level.own_walk();
    const bool key = own == nullptr && level.walks.empty();
    made_.states[at] = key ? kKeyBlock : static_cast<uint8_t>(level.state());
    made_.read[at] = bits_read(level);
    const unsigned side = decoder_.header().block_size();
    made_.bits[at] = bits_alone(level, size_t{side} * side);
    if (level.stage("residual") != nullptr && own != nullptr) {
      if (const auto code = own->level_code()) made_.level_counts[at] = levels_of_code(*code).count;
      if (const auto code = own->step_code())
        made_.steps[at] = static_cast<uint32_t>(step_of_code(*code));
    }
    if (level.vectors.empty()) return;
    const std::lock_guard lock(mutex_);
    for (const VectorRecord& vector : level.vectors) {
      made_.vectors.push_back({at, vector.image_row, vector.image_col, vector.x, vector.y});
    }
  }

  void copy_stages(const cli::TracedLevel& level, uint32_t bx, uint32_t by) {
    const uint32_t side = decoder_.header().block_size();
    const uint32_t width = std::min(side, made_.size.width - bx * side);
    const uint32_t height = std::min(side, made_.size.height - by * side);
    for (size_t k = 0; k < kStageNames.size(); ++k) {
      const cli::RecordedStage* stage = level.stage(kStageNames[k]);
      if (stage == nullptr) continue;
      for (uint32_t y = 0; y < height; ++y) {
        const size_t to = size_t{by * side + y} * made_.size.width + bx * side;
        for (uint32_t x = 0; x < width; ++x) {
          made_.stages[k][to + x] = static_cast<int16_t>(stage->values[y * side + x]);
        }
      }
    }
  }

  const Decoder& decoder_;
  ViewPos view_;
  Plane plane_;
  int stop_level_;
  PlaneTrace made_;
  std::mutex mutex_;
};

}  // namespace

PlaneTrace trace_plane(const Decoder& decoder, ViewPos view, Plane plane, int stop_level) {
  return Tracer(decoder, view, plane, stop_level).run();
}

}  // namespace hmlfc::view
