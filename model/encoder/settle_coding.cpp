#include "encoder/coding_params.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "arithmetic/rounding.hpp"
#include "encoder/coding_trial.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

// Views of a group along a row or a column, where nothing is tried.
constexpr double kUsualGroup = 5;
// For a target, the quality that trials predict is refined so often at most, until it moves by less
// than kNextQuality. What was found for a quality serves others that are near; where the first one
// is not, nothing is looked for with it.
constexpr int kMaxRounds = 3;
constexpr double kNextQuality = 2;
constexpr double kNearQuality = 8;
// What counts as the surplus of a coding without errors.
constexpr double kMostSurplusDb = 100;
// The share by which a coding has to be cheaper than what it replaces: trials are that exact.
constexpr double kMatters = 0.003;
// Views that are all key images have no geometry, and no block decodes without all of its view.
constexpr double kMattersMuch = 0.1;
// Where rows are so many times as far apart as columns, or the other way round, groups of other
// shapes are tried.
constexpr double kUneven = 1.4;

// Images that a trial codes.
size_t trial_images(Preset preset) {
  return preset == Preset::kFast ? 12 : preset == Preset::kMedium ? 16 : 32;
}

// Whether finer disparities are tried, too.
bool tries_grid(const EncodeParams& params) { return params.extended.preset != Preset::kFast; }

// How far apart rows of cameras are, by how far columns are.
double rows_by_columns(const LightFieldProbe& probe) { return std::abs(probe.row_scale) / 16.0; }

// Sizes of groups for a line of `count` views, ascending: each cuts it into a sixth fewer groups
// than the one before, at least.
std::vector<uint32_t> group_sizes(uint32_t count) {
  std::vector<uint32_t> sizes;
  for (uint32_t size = 1; size <= std::min(count, 255u); ++size) {
    const uint32_t groups = ceil_div(count, size);
    if (sizes.empty() || 6 * groups <= 5 * ceil_div(count, sizes.back())) sizes.push_back(size);
  }
  return sizes;
}

// The cheapest coding by trial, from a first guess on: a better one is looked for next to the
// best so far until there is none.
class CodingSearch {
 public:
  CodingSearch(const LightFieldShape& shape, const TrialParts& parts, const EncodeParams& params,
               const LightFieldProbe& probe, const Progress& progress)
      : shape_(shape),
        parts_(parts),
        probe_(probe),
        progress_(progress),
        lambda_(lambda_of_quality(params.extended.quality)),
        rows_(group_sizes(shape.rows)),
        cols_(group_sizes(shape.cols)),
        best_(params) {
    best_result_ = trial(best_);
    least_ = best_result_.cost(lambda_);
    tried_.insert({best_.ref_rows, best_.ref_cols});
  }

  void find_groups() {
    if (!go_on(1, 1)) go_on(-1, -1);
    const double rows = rows_by_columns(probe_);
    if (rows > kUneven || best_.ref_rows == 1) {
      go_on(-1, 0);
      go_on(0, 1);
    } else if (rows < 1 / kUneven || best_.ref_cols == 1) {
      go_on(0, -1);
      go_on(1, 0);
    }
  }

  // Finer disparities.
  void find_grid() {
    if (!tries_grid(best_) || best_.block_size > 4) return;
    EncodeParams tried = best_;
    tried.extended.disparity_grid = 4;
    attempt(tried);
  }

  const EncodeParams& best() const { return best_; }
  EncodeForecast forecast() const { return {best_result_.seconds, best_result_.bits / 8}; }

  // By how much it exceeds `goal`, as far as trials can say; 0 without one.
  double surplus_db(const EncodeGoal* goal) const {
    if (goal == nullptr) return 0;
    return std::min(kMostSurplusDb, goal->surplus_db(psnr_db(), best_result_.bits / 8));
  }

 private:
  // Over RGB.
  double psnr_db() const {
    const uint64_t samples = uint64_t{shape_.rows} * shape_.cols * shape_.width * shape_.height * 3;
    return psnr(static_cast<uint64_t>(best_result_.rgb_squares), samples, shape_.depth);
  }

  TrialResult trial(const EncodeParams& params) const {
    if (progress_) progress_(0, uint64_t{shape_.rows} * shape_.cols);
    return try_coding(shape_, parts_, params, probe_, trial_images(params.extended.preset));
  }

  bool attempt(const EncodeParams& params) {
    const TrialResult result = trial(params);
    const double cost = result.cost(lambda_);
    const bool all_keys = params.ref_rows == 1 && params.ref_cols == 1;
    if (!(cost < least_ * (1 - (all_keys ? kMattersMuch : kMatters)))) return false;
    least_ = cost;
    best_ = params;
    best_result_ = result;
    return true;
  }

  // Goes over to groups with fewer (-1) or more (1) rows and columns as long as they are cheaper;
  // whether it did.
  bool go_on(int rows, int cols) {
    const auto last = std::pair{best_.ref_rows, best_.ref_cols};
    for (bool better = true; better;) {
      EncodeParams tried = best_;
      tried.ref_rows = neighbour(rows_, best_.ref_rows, rows);
      tried.ref_cols = neighbour(cols_, best_.ref_cols, cols);
      better = tried_.insert({tried.ref_rows, tried.ref_cols}).second && attempt(tried);
    }
    return last != std::pair{best_.ref_rows, best_.ref_cols};
  }

  static uint32_t neighbour(const std::vector<uint32_t>& sizes, uint32_t size, int move) {
    const auto at = std::lower_bound(sizes.begin(), sizes.end(), size) - sizes.begin() + move;
    return sizes[static_cast<size_t>(
        std::clamp<ptrdiff_t>(at, 0, static_cast<ptrdiff_t>(sizes.size()) - 1))];
  }

  const LightFieldShape& shape_;
  const TrialParts& parts_;
  const LightFieldProbe& probe_;
  const Progress& progress_;
  Lambda lambda_;
  std::vector<uint32_t> rows_;
  std::vector<uint32_t> cols_;
  EncodeParams best_;
  TrialResult best_result_;
  double least_ = 0;
  std::set<std::pair<uint32_t, uint32_t>> tried_;
};

// The largest size of groups for a line of `count` views that is at most `wanted`, or 1.
uint32_t size_near(uint32_t count, double wanted) {
  const std::vector<uint32_t> sizes = group_sizes(count);
  const auto above = std::upper_bound(sizes.begin() + 1, sizes.end(), wanted);
  return *(above - 1);
}

// The mean squared error over RGB that halved chroma alone may cost: an eighth of the target's, or
// a tenth of what a bit is worth.
double max_chroma_error(const LightFieldShape& shape, const EncodeParams& params,
                        const EncodeGoal* goal) {
  if (goal != nullptr && goal->psnr() != nullptr) {
    return error_of_psnr(goal->psnr()->db, shape.depth) / 8;
  }
  return static_cast<double>(lambda_of_quality(params.extended.quality).scaled) / 256 / 10;
}

ChromaFormat chroma_for(const ViewProvider& views, const EncodeParams& params,
                        const EncodeGoal* goal) {
  EncodeParams halved = params;
  halved.chroma = ChromaFormat::k420;
  const auto header = header_for(views.shape(), halved);
  if (!header || params.lossless) return ChromaFormat::k444;
  const Geometry geometry(*header);
  const ImagePos middle{header->rows / 2, header->cols / 2};
  const ErrorSums error =
      view_error(views, middle, view_planes(views, geometry, middle), ChromaFormat::k420);
  const double samples = static_cast<double>(header->width) * header->height * 3;
  const bool costly = static_cast<double>(error.rgb_squares) / samples >
                      max_chroma_error(views.shape(), params, goal);
  return costly ? ChromaFormat::k444 : ChromaFormat::k420;
}

// Probes with the row scale that `params`, of which nothing is open, cost least with.
LightFieldProbe probe_by_trial(const ViewProvider& views, const StreamHeader& header,
                               const TrialParts& parts, const EncodeParams& params) {
  const std::vector<int> row_scales = likely_row_scales(views, header);
  LightFieldProbe usual = probe_light_field(views, header, row_scales.front());
  if (row_scales.size() == 1 || header.tree_height > 0) return usual;
  LightFieldProbe other = probe_light_field(views, header, row_scales.back());
  const auto cost = [&](const LightFieldProbe& probe) {
    return try_coding(views.shape(), parts, params, probe, trial_images(params.extended.preset))
        .cost(lambda_of_quality(params.extended.quality));
  };
  return cost(other) < cost(usual) ? other : usual;
}

// Settles by trial what is open in `asked`; for a target the quality, too.
void search_coding(const LightFieldShape& shape, const TrialParts& parts, const EncodeParams& asked,
                   const EncodeGoal* goal, const Progress& progress, SettledCoding& settled) {
  EncodeParams& found = settled.params;
  const bool open_groups = asked.ref_rows == 0 || asked.ref_cols == 0;
  double searched = std::numeric_limits<double>::infinity();  // the quality of the last search
  std::optional<QualitySurplus> last;
  double low = lowest_quality(shape.depth) - 1;  // what is too low, as far as trials can say
  double high = kHighestQuality + 1;
  for (int round = 0; round < kMaxRounds; ++round) {
    CodingSearch search(shape, parts, found, settled.probe, progress);
    const double first = search.surplus_db(goal);
    const bool far = round == 0 && std::abs(first) > kNearQuality * kDbPerQuality;
    if (!far && std::abs(found.extended.quality - searched) > kNearQuality) {
      if (open_groups) search.find_groups();
      if (asked.extended.disparity_grid == 0) search.find_grid();
      searched = found.extended.quality;
    }
    found = search.best();
    settled.forecast = search.forecast();
    if (goal == nullptr) break;
    const QualitySurplus now{found.extended.quality, search.surplus_db(goal)};
    if (last) settled.db_per_quality = db_per_quality(*last, now);
    (now.db < 0 ? low : high) = now.quality;
    double& next = found.extended.quality;
    next = next_quality(now, settled.db_per_quality, shape.depth);
    if (next <= low || next >= high) next = std::round((low + high) * 4) / 8;
    settled.forecast->bytes *= EncodeGoal::bytes_for(next - now.quality);
    if (std::abs(next - now.quality) < kNextQuality) break;
    last = now;
  }
}

}  // namespace

SettledCoding settle_coding(const ViewProvider& views, const EncodeParams& params,
                            const EncodeGoal* goal, uint64_t cache_bytes,
                            const Progress& progress) {
  const LightFieldShape& shape = views.shape();
  SettledCoding settled{params, {}};
  EncodeParams& found = settled.params;
  const bool open_groups = params.ref_rows == 0 || params.ref_cols == 0;
  // What is known of the light field is the same whatever trials choose: who takes a part of a plan
  // knows their choice before.
  EncodeParams usual = params;
  usual.ref_rows = size_near(shape.rows, kUsualGroup);
  usual.ref_cols = size_near(shape.cols, kUsualGroup);
  usual.extended.disparity_grid = 8;
  if (found.extended.disparity_grid == 0) found.extended.disparity_grid = 8;
  if (!found.chroma) found.chroma = chroma_for(views, usual, goal);
  usual.chroma = found.chroma;
  const auto header = header_for(shape, usual);
  if (!header || params.profile == Profile::kMain) return settled;
  const TrialParts parts = trial_parts(views, cache_bytes);
  settled.probe = probe_by_trial(views, *header, parts, usual);
  if (open_groups) {
    const double uneven = std::sqrt(rows_by_columns(settled.probe));
    found.ref_rows = size_near(shape.rows, kUsualGroup / uneven);
    found.ref_cols = size_near(shape.cols, kUsualGroup * uneven);
  }
  if (!header->has(Feature::kMotionTiles) || header->tree_height > 0) return settled;
  const bool open_grid = params.extended.disparity_grid == 0 && tries_grid(params);
  if (!open_groups && goal == nullptr && !open_grid) return settled;
  search_coding(shape, parts, params, goal, progress, settled);
  if (goal != nullptr && !params.chroma) {
    // A number of bytes says only now what chroma may cost.
    EncodeParams again = params;
    again.chroma = chroma_for(views, found, goal);
    if (again.chroma == found.chroma) return settled;
    return settle_coding(views, again, goal, cache_bytes, progress);
  }
  return settled;
}

}  // namespace hmlfc
