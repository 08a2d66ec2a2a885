// What people read of a Lockstep: a difference, and the statistics.
#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "dut/lockstep.hpp"

namespace hmlfc::lockstep {
namespace {

constexpr std::array<const char*, 4> kPlaneNames{"Y", "Co", "Cg", "RGB"};
constexpr int64_t kWaveMargin = 16;  // clocks on both sides of request and difference

// The name of a status; empty for one that is not in annex A.
std::string_view name_of(int status) {
  const bool known = status >= 0 && status < kErrorCodeCount;
  return known ? error_name(static_cast<ErrorCode>(status)) : std::string_view();
}

}  // namespace

std::string status_text(int status) {
  const std::string_view name = name_of(status);
  return name.empty() ? std::to_string(status) : fmt::format("{} ({})", status, name);
}

std::string expected_actual(const std::string& expected, const std::string& actual) {
  return fmt::format("  expected   {}\n  actual     {}\n", expected, actual);
}

void Lockstep::report(int64_t clock, const Pending* pending, const Difference& difference) {
  ++differences_;
  ++rules_[difference.rule];
  auto out = std::back_inserter(text_);
  fmt::format_to(out, "hmlfc_checker: difference {} at clock {}: {}\n", differences_, clock,
                 difference.rule);
  if (pending != nullptr) {
    const Request& r = pending->request;
    fmt::format_to(out,
                   "  request    {}: view {},{} plane {} block {},{} stop level {}, taken at clock "
                   "{}\n",
                   pending->number, r.row, r.col, kPlaneNames[static_cast<size_t>(r.plane)],
                   r.block_x, r.block_y, r.stop_level, pending->clock);
  }
  text_ += difference.detail;
  if (pending != nullptr && pending->skipped.empty()) text_ += origin(*pending, difference.site);
  const int64_t first = (pending != nullptr ? pending->clock : clock) - kWaveMargin;
  fmt::format_to(out,
                 "  wave       run again with +hmlfc_checker_wave=hmlfc_checker.vcd "
                 "+hmlfc_checker_first={} +hmlfc_checker_last={}\n",
                 std::max<int64_t>(first, 0), clock + kWaveMargin);
}

// The command that shows the block of `site`, or else of the request, with all fields and stages.
std::string Lockstep::origin(const Pending& pending, const BlockSite* site) const {
  const Request& r = pending.request;
  if (model_->status() != 0 ||
      pending.expected.status == static_cast<int>(ErrorCode::kBadRequest)) {
    return {};
  }
  BlockSite block;
  block.plane = r.plane == kRgb ? Plane::kY : static_cast<Plane>(r.plane);
  block.bx = static_cast<uint32_t>(r.block_x);
  block.by = static_cast<uint32_t>(r.block_y);
  if (site == nullptr) site = &block;
  return fmt::format("  more       hmlfc inspect {} --view {},{} --plane {} --block {},{}\n",
                     stream_, r.row, r.col, plane_name(site->plane), site->bx, site->by);
}

std::string Lockstep::statistics() const {
  std::string text = fmt::format("hmlfc_checker: statistics of {} on {}\n", device_.name, stream_);
  auto out = std::back_inserter(text);
  fmt::format_to(out, "  requests          {}\n", requests_);
  fmt::format_to(out, "  answers           {}, compared {}\n", answers_, compared_);
  if (dropped_ != 0) fmt::format_to(out, "  dropped by reset  {}\n", dropped_);
  fmt::format_to(out, "  stage records     {}, compared {}\n", records_, records_compared_);
  for (size_t i = 0; i < kStageNames.size(); ++i) {
    if (!device_.stages[i]) continue;
    fmt::format_to(out, "    {:<16}{}\n", kStageNames[i], stages_compared_[i]);
  }
  if (held_ != 0) {
    fmt::format_to(out, "  not shown         {} records that the device may leave out\n", held_);
  }
  for (const auto& [status, count] : statuses_) {
    const std::string_view name = name_of(status);
    fmt::format_to(out, "  status {}  {}  {}\n", status, count,
                   name.empty() ? "not in annex A" : name);
  }
  for (const auto& [why, count] : skipped_) {
    fmt::format_to(out, "  skipped           {}  {}\n", count, why);
  }
  for (const auto& [rule, count] : rules_) {
    fmt::format_to(out, "  difference        {}  {}\n", count, rule);
  }
  const std::string verdict =
      differences_ != 0 ? fmt::format("FAILED: {} differences", differences_)
      : compared_ == 0  ? "FAILED: nothing was compared"
                        : fmt::format("passed: {} answers are the model's", compared_);
  return text + "hmlfc_checker: " + verdict + "\n";
}

}  // namespace hmlfc::lockstep
