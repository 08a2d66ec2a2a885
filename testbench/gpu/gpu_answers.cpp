#include "gpu/gpu_answers.hpp"

#include <algorithm>

#include "decode/block_stages.hpp"

namespace hmlfc::gpu {
namespace {

BlockArea area_of(const tb::Request& request) {
  BlockArea area;
  area.view = {request.row, request.col};
  area.plane = static_cast<Plane>(request.plane);
  area.bx = request.bx;
  area.by = request.by;
  area.stop_level = static_cast<int>(request.stop_level);
  return area;
}

PixelArea pixel_area_of(const tb::Request& request) {
  return {{request.row, request.col},          request.bx, request.by, 1, 1,
          static_cast<int>(request.stop_level)};
}

// Answer `number` of `blocks`, whose answers have `count` samples.
template <class Decoded>
void fill_answer(const Decoded& blocks, size_t number, size_t count, tb::Answer& answer) {
  answer.status = blocks.statuses[number];
  std::copy_n(blocks.samples.begin() + static_cast<ptrdiff_t>(number * count), count,
              answer.samples.begin());
}

void copy_stage(const std::vector<int16_t>& values, tb::StageValues& out) {
  std::ranges::copy(values, out.begin());
}

tb::LevelRecord record_of(const tb::Request& request, const LevelStages& stages) {
  tb::LevelRecord record;
  record.site.level = stages.level;
  record.site.plane = static_cast<Plane>(request.plane);
  record.site.bx = request.bx;
  record.site.by = request.by;
  record.key = stages.key;
  record.motion = stages.references != 0;
  record.negative = stages.negative;
  record.references = stages.references;
  record.vectors = stages.vectors;
  record.has_residual = stages.has_residual;
  record.error = stages.status;
  copy_stage(stages.residual, record.residual);
  copy_stage(stages.reference, record.reference);
  copy_stage(stages.prediction, record.prediction);
  copy_stage(stages.sample, record.sample);
  return record;
}

}  // namespace

Outcome<std::vector<tb::Answer>> gpu_answers(GpuDecoder& decoder, unsigned block_size,
                                             std::span<const tb::Request> requests) {
  std::vector<BlockArea> areas;
  std::vector<PixelArea> pixel_areas;
  for (const tb::Request& request : requests) {
    if (request.plane == tb::kRgb) {
      pixel_areas.push_back(pixel_area_of(request));
    } else {
      areas.push_back(area_of(request));
    }
  }
  const auto blocks = decoder.decode(areas);
  if (!blocks) return tl::unexpected(blocks.error());
  const auto pixels = decoder.decode_rgb(pixel_areas);
  if (!pixels) return tl::unexpected(pixels.error());
  std::vector<tb::Answer> answers(requests.size());
  size_t block = 0;
  size_t pixel = 0;
  const size_t lane = size_t{block_size} * block_size;
  for (size_t i = 0; i < requests.size(); ++i) {
    answers[i].last = requests[i].last;
    if (requests[i].plane == tb::kRgb) {
      fill_answer(*pixels, pixel++, tb::kLanes * lane, answers[i]);
    } else {
      fill_answer(*blocks, block++, lane, answers[i]);
    }
  }
  return answers;
}

Outcome<std::vector<GpuTrace>> gpu_traces(GpuDecoder& decoder,
                                          std::span<const tb::Request> requests) {
  std::vector<BlockArea> areas;
  std::ranges::transform(requests, std::back_inserter(areas), area_of);
  const auto blocks = decoder.trace(areas);
  if (!blocks) return tl::unexpected(blocks.error());
  std::vector<GpuTrace> traces;
  for (size_t i = 0; i < requests.size(); ++i) {
    GpuTrace trace;
    trace.status = (*blocks)[i].status;
    for (const LevelStages& stages : (*blocks)[i].levels) {
      trace.levels.push_back(record_of(requests[i], stages));
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

}  // namespace hmlfc::gpu
