#include "systemc/coverage.hpp"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "arithmetic/widths.hpp"

namespace hmlfc::tb {
namespace {

#define HMLFC_POINT(point, name) name,
constexpr std::array<std::string_view, kPointCount> kNames{HMLFC_POINTS(HMLFC_POINT)};
#undef HMLFC_POINT

constexpr unsigned kLongLatency = 100;

// The errors of annex A that the unit names itself; bad_request and bus_error have
// points of their own. The others are for software, which reads sections whole and key images.
constexpr std::array kNamedByUnit{
    ErrorCode::kTruncated,      ErrorCode::kBadMagic,        ErrorCode::kBadVersion,
    ErrorCode::kBadHeaderCrc,   ErrorCode::kBadProfile,      ErrorCode::kBadFeature,
    ErrorCode::kBadHeaderField, ErrorCode::kBadSectionTable, ErrorCode::kTrailingBytes,
    ErrorCode::kBadSectionSize, ErrorCode::kBadRootEntry,    ErrorCode::kBadGroupRecord,
    ErrorCode::kBadTileOffset,  ErrorCode::kTileOverrun,     ErrorCode::kMaskOutside,
    ErrorCode::kBadMode,        ErrorCode::kBadLevels,       ErrorCode::kVectorRange,
    ErrorCode::kLimitExceeded};

}  // namespace

void Coverage::on_expected(const ExpectedAnswer& expected, const GoldenStream* stream) {
  const Request& request = expected.request;
  hit(static_cast<Point>(static_cast<unsigned>(Point::kPlaneY) + request.plane));
  if (request.last) hit(Point::kRequestLast);
  if (has_previous_) {
    if (request.word() == previous_.word()) hit(Point::kRequestRepeated);
    if (request.row != previous_.row || request.col != previous_.col) hit(Point::kViewChanged);
  }
  previous_ = request;
  has_previous_ = true;
  if (stream == nullptr || !expected.planes[0]) return;
  const auto top = static_cast<unsigned>(stream->header().tree_height);
  if (request.stop_level == 0) hit(Point::kStopLevelZero);
  if (request.stop_level > 0 && request.stop_level < top) hit(Point::kStopLevelBetween);
  if (request.stop_level > 0 && request.stop_level == top) hit(Point::kStopLevelTop);
  if (expected.inside_x < stream->geometry().block_size()) hit(Point::kBorderRight);
  if (expected.inside_y < stream->geometry().block_size()) hit(Point::kBorderBelow);
  for (const auto& plane : expected.planes) {
    if (!plane || plane->status != 0) continue;
    for (const LevelRecord& level : plane->levels) on_level(level, *stream);
  }
}

void Coverage::on_level(const LevelRecord& level, const GoldenStream& stream) {
  if (level.key) {
    hit(Point::kKeyBlock);
    return;
  }
  hit(static_cast<Point>(static_cast<unsigned>(Point::kStateZero) +
                         static_cast<unsigned>(level.state())));
  const unsigned count = stream.geometry().block_size() * stream.geometry().block_size();
  const SampleRange range = sample_range(level.site.plane, stream.header().depth);
  const auto end = level.sample.begin() + count;
  if (std::find(level.sample.begin(), end, range.lo) != end) hit(Point::kSampleLow);
  if (std::find(level.sample.begin(), end, range.hi) != end) hit(Point::kSampleHigh);
  if (!level.motion) return;
  if (level.negative) hit(Point::kSignMinus);
  hit(level.references == 1 ? Point::kOneReference : Point::kTwoReferences);
  for (unsigned i = 0; i < level.references; ++i) on_vector(level, level.vectors[i], stream);
}

void Coverage::on_vector(const LevelRecord& level, const SubpelVector& vector,
                         const GoldenStream& stream) {
  const bool x = vector.fx != 0;
  const bool y = vector.fy != 0;
  hit(x && y ? Point::kPhaseBoth : x ? Point::kPhaseX : y ? Point::kPhaseY : Point::kPhaseWhole);
  const PlaneShape& shape = stream.geometry().plane(level.site.plane);
  const auto size = static_cast<int32_t>(stream.geometry().block_size());
  const int32_t left = static_cast<int32_t>(level.site.bx) * size + vector.ix;
  const int32_t above = static_cast<int32_t>(level.site.by) * size + vector.iy;
  if (left < 0 || above < 0 || left + size > static_cast<int32_t>(shape.width) ||
      above + size > static_cast<int32_t>(shape.height)) {
    hit(Point::kReferenceOutside);
  }
}

void Coverage::on_answer(const ExpectedAnswer& expected, const Answer& answer) {
  if (answer.status == 0) return;
  on_error(answer.status);
  if (answer.status == kBusError) {
    hit(Point::kStatusBusError);
  } else if (!expected.planes[0]) {
    hit(answer.status == static_cast<uint8_t>(ErrorCode::kBadRequest) ? Point::kStatusBadRequest
                                                                      : Point::kLoadFailed);
  } else {
    hit(Point::kStatusOfBlock);
  }
}

void Coverage::on_conditions(const Conditions& conditions) {
  if (conditions.latency == 0) hit(Point::kLatencyNone);
  if (conditions.latency >= kLongLatency) hit(Point::kLatencyLong);
  if (conditions.stall != 0) hit(Point::kReadStall);
  if (conditions.address_stall != 0) hit(Point::kAddressStall);
  if (conditions.backpressure != 0) hit(Point::kBackpressure);
  if (conditions.request_gap != 0) hit(Point::kRequestGap);
}

void Coverage::on_stream(const StreamHeader& header) {
  hit(header.profile == Profile::kMain ? Point::kMain : Point::kExtended);
  hit(header.chroma_format == ChromaFormat::k420 ? Point::kChroma420 : Point::kChroma444);
  if (header.rows == 1 && header.cols == 1) hit(Point::kOneView);
  if (header.tree_height > 0 &&
      (header.rows % header.cluster_rows != 0 || header.cols % header.cluster_cols != 0)) {
    hit(Point::kUnevenGrid);
  }
  if (header.depth > 8) hit(Point::kDepthAboveEight);
}

void Coverage::on_error(uint8_t error) {
  if (error < kErrorCodeCount) ++errors_[error];
}

std::vector<NamedCount> Coverage::all() const {
  std::vector<NamedCount> all;
  for (size_t i = 0; i < kPointCount; ++i) all.push_back({std::string(kNames[i]), hits_[i]});
  for (const ErrorCode code : kNamedByUnit) {
    all.push_back({"error " + std::string(error_name(code)), errors_[static_cast<size_t>(code)]});
  }
  return all;
}

std::vector<std::string> Coverage::missed() const {
  std::vector<std::string> names;
  for (const auto& [name, hits] : all()) {
    if (hits == 0) names.push_back(name);
  }
  return names;
}

std::string Coverage::report() const {
  std::string text;
  for (const auto& [name, hits] : all()) text += name + ": " + std::to_string(hits) + "\n";
  return text;
}

std::string Coverage::to_json() const {
  nlohmann::ordered_json json;
  for (const auto& [name, hits] : all()) json[name] = hits;
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::tb
