#include "encoder/coding_params.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "arithmetic/rounding.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/plane_targets.hpp"

namespace hmlfc {
namespace {

// The largest part of a view on which groups are tried.
constexpr uint32_t kTrialWidth = 192;
constexpr uint32_t kTrialHeight = 160;
// Views of a group along a row or a column, where nothing is tried.
constexpr uint32_t kUsualGroup = 5;

LightField middle_of(const LightField& light_field) {
  LightFieldShape shape = light_field.shape();
  const uint32_t x = (shape.width - std::min(shape.width, kTrialWidth)) / 2;
  const uint32_t y = (shape.height - std::min(shape.height, kTrialHeight)) / 2;
  const LightFieldShape whole = shape;
  shape.width = std::min(shape.width, kTrialWidth);
  shape.height = std::min(shape.height, kTrialHeight);
  LightField part(shape);
  std::vector<uint16_t> pixels(size_t{whole.width} * 3);
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      for (uint32_t j = 0; j < shape.height; ++j) {
        light_field.read_row(row, col, y + j, pixels);
        part.write_row(row, col, j,
                       std::span(pixels).subspan(size_t{x} * 3, size_t{shape.width} * 3));
      }
    }
  }
  return part;
}

// Sizes of groups along a line of `count` views that cut it into different numbers of groups.
std::vector<uint32_t> group_sizes(uint32_t count, Preset preset) {
  const std::vector<uint32_t> wanted = preset == Preset::kSlow
                                           ? std::vector<uint32_t>{2, 3, 4, 5, 6, 8, 12}
                                           : std::vector<uint32_t>{3, 5, 8};
  std::vector<uint32_t> sizes;
  for (const uint32_t size : wanted) {
    const uint32_t groups = ceil_div(count, size);
    const uint32_t balanced = ceil_div(count, groups);
    if (sizes.empty() || ceil_div(count, sizes.back()) != groups) sizes.push_back(balanced);
  }
  return sizes;
}

// D + lambda R of all views of `part`.
double trial_cost(const LightField& part, const EncodeParams& params) {
  const auto header = header_for(part.shape(), params);
  if (!header) return std::numeric_limits<double>::max();
  EncodeSession session(part, *header);
  CodedImages images = session.encode(params, true, {});
  const auto bits = static_cast<double>(session.stream(images).size()) * 8;
  return static_cast<double>(images.error.rgb_squares) / 3 +
         static_cast<double>(lambda_of_quality(params.extended.quality).scaled) / 256 * bits;
}

void settle_groups(const LightField& light_field, EncodeParams& params) {
  const LightFieldShape& shape = light_field.shape();
  params.ref_rows = std::min(kUsualGroup, shape.rows);
  params.ref_cols = std::min(kUsualGroup, shape.cols);
  if (params.extended.preset == Preset::kFast || params.lossless) return;
  const LightField part = middle_of(light_field);
  EncodeParams best = params;
  double least = std::numeric_limits<double>::max();
  for (const uint32_t size :
       group_sizes(std::max(shape.rows, shape.cols), params.extended.preset)) {
    EncodeParams tried = params;
    tried.extended.preset = Preset::kFast;
    tried.ref_rows = std::min(size, shape.rows);
    tried.ref_cols = std::min(size, shape.cols);
    const double cost = trial_cost(part, tried);
    if (cost >= least) continue;
    least = cost;
    best.ref_rows = tried.ref_rows;
    best.ref_cols = tried.ref_cols;
  }
  params = best;
}

// The mean squared error over RGB that halved chroma alone may cost: an eighth of the target's, or
// a tenth of what a bit is worth.
double max_chroma_error(const LightFieldShape& shape, const EncodeParams& params,
                        std::optional<double> target_db) {
  if (target_db) {
    const double peak = static_cast<double>((1 << shape.depth) - 1);
    return peak * peak * std::pow(10.0, -*target_db / 10) / 8;
  }
  return static_cast<double>(lambda_of_quality(params.extended.quality).scaled) / 256 / 10;
}

ChromaFormat chroma_for(const LightField& light_field, const EncodeParams& params,
                        std::optional<double> target_db) {
  EncodeParams halved = params;
  halved.chroma = ChromaFormat::k420;
  const auto header = header_for(light_field.shape(), halved);
  if (!header || params.lossless) return ChromaFormat::k444;
  const Geometry geometry(*header);
  const ImagePos middle{header->rows / 2, header->cols / 2};
  const ErrorSums error = view_error(
      light_field, middle, view_planes(light_field, geometry, middle), ChromaFormat::k420);
  const double samples = static_cast<double>(header->width) * header->height * 3;
  const bool costly = static_cast<double>(error.rgb_squares) / samples >
                      max_chroma_error(light_field.shape(), params, target_db);
  return costly ? ChromaFormat::k444 : ChromaFormat::k420;
}

}  // namespace

EncodeParams settle_coding(const LightField& light_field, const EncodeParams& params,
                           std::optional<double> target_db) {
  EncodeParams settled = params;
  const bool open_groups = params.ref_rows == 0 || params.ref_cols == 0;
  if (open_groups) {
    settled.ref_rows = std::max(1u, std::min(kUsualGroup, light_field.shape().rows));
    settled.ref_cols = std::max(1u, std::min(kUsualGroup, light_field.shape().cols));
  }
  if (!params.chroma) settled.chroma = chroma_for(light_field, settled, target_db);
  if (open_groups) settle_groups(light_field, settled);
  return settled;
}

}  // namespace hmlfc
