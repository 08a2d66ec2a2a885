#include "conform/view_judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/difference.hpp"
#include "conform/stage_trace.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::conform {
namespace {

std::vector<RgbImage> golden_views(const Decoder& golden) {
  const StreamHeader& header = golden.header();
  std::vector<RgbImage> views;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      auto view = golden.decode_view({row, col});
      if (!view) return {};
      views.push_back(std::move(*view));
    }
  }
  return views;
}

std::string sum_of(const std::vector<RgbImage>& views) {
  std::vector<uint8_t> raw;
  for (const RgbImage& view : views) {
    const auto bytes = vectors::picture_bytes(view);
    raw.insert(raw.end(), bytes.begin(), bytes.end());
  }
  return vectors::sha256(raw);
}

}  // namespace

std::string wrong_stage(const Decoder& golden, const BlockAddress& block, int stop_level,
                        const Tracer& tracer) {
  if (!tracer) return {};
  const auto trace = tracer(block, stop_level);
  const auto stages = parse_stages(trace ? std::string_view(*trace) : std::string_view());
  if (stages.empty()) return "no trace" + (trace ? "" : ": " + trace.error());
  if (auto stage = first_wrong_stage(golden, block, stop_level, stages)) return *stage;
  return fmt::format("all stages of plane {} agree in the decoder's trace",
                     plane_name(block.plane));
}

Result<Decoder> golden_decoder(const Trial& trial, VectorResult& result) {
  OpenOptions options;
  options.check_sections = false;
  auto golden = Decoder::open(trial.stream, options);
  if (!golden) {
    result.status = Status::kError;
    result.reason = "the golden model cannot open the stream: " + to_string(golden.error());
  }
  return golden;
}

void describe_difference(const Trial& trial, const Decoder& golden,
                         const std::vector<RgbImage>& expected, const std::vector<RgbImage>& actual,
                         const Tracer& tracer, VectorResult& result) {
  const StreamHeader& header = golden.header();
  result.difference = first_difference(expected, actual, header.cols, header.block_size());
  if (!result.difference) return;
  const Difference& difference = *result.difference;
  result.status = Status::kFail;
  result.reason = to_string(difference);
  std::vector<std::string> stages;
  for (const Plane plane : difference.planes) {
    const bool halved = plane != Plane::kY && header.chroma_format == ChromaFormat::k420;
    const BlockAddress block{difference.view, plane, difference.block_x >> (halved ? 1 : 0),
                             difference.block_y >> (halved ? 1 : 0)};
    if (tracer) stages.push_back(wrong_stage(golden, block, 0, tracer));
  }
  result.stage = fmt::format("{}", fmt::join(stages, "; "));
  if (trial.pictures.empty()) return;
  const size_t view = size_t{difference.view.row} * header.cols + difference.view.col;
  const auto written = write_failure_pictures(trial.pictures, expected[view], actual[view]);
  if (!written) result.messages += "\n" + written.error().message;
}

void judge_views(const Trial& trial, const Decoder& golden, const std::vector<RgbImage>& actual,
                 const vectors::ViewSum* output, const Tracer& tracer, VectorResult& result) {
  result.status = Status::kPass;
  if (output != nullptr && sum_of(actual) == output->sha256) return;
  const auto expected = golden_views(golden);
  if (expected.empty()) {
    result.status = Status::kError;
    result.reason = "the golden model cannot decode the stream";
    return;
  }
  describe_difference(trial, golden, expected, actual, tracer, result);
  if (result.difference || output == nullptr) return;
  result.status = Status::kError;
  result.reason =
      "equal to the golden model, which differs from the manifest: the suite is of another version "
      "or damaged";
}

}  // namespace hmlfc::conform
