// What people read of a Lockstep: a difference, and the statistics.
#include <algorithm>
#include <array>
#include <sstream>

#include "dut/lockstep.hpp"

namespace hmlfc::lockstep {
namespace {

constexpr std::array<const char*, 4> kPlaneNames{"Y", "Co", "Cg", "RGB"};
constexpr int64_t kWaveMargin = 16;  // clocks on both sides of request and difference

template <class Counts>
void show(std::ostream& out, const char* title, const Counts& counts) {
  for (const auto& [name, count] : counts) out << title << count << "  " << name << "\n";
}

}  // namespace

std::string status_text(int status) {
  const bool known = status >= 0 && status < kErrorCodeCount;
  return std::to_string(status) +
         (known ? " (" + std::string(error_name(static_cast<ErrorCode>(status))) + ")" : "");
}

std::string expected_actual(const std::string& expected, const std::string& actual) {
  return "  expected   " + expected + "\n  actual     " + actual + "\n";
}

void Lockstep::report(int64_t clock, const Pending* pending, const Difference& difference) {
  ++differences_;
  ++rules_[difference.rule];
  std::ostringstream out;
  out << "hmlfc_checker: difference " << differences_ << " at clock " << clock << ": "
      << difference.rule << "\n";
  if (pending != nullptr) {
    const Request& r = pending->request;
    out << "  request    " << pending->number << ": view " << r.row << "," << r.col << " plane "
        << kPlaneNames[static_cast<size_t>(r.plane)] << " block " << r.block_x << "," << r.block_y
        << " stop level " << r.stop_level << ", taken at clock " << pending->clock << "\n";
  }
  out << difference.detail;
  if (pending != nullptr && pending->skipped.empty()) out << origin(*pending, difference.site);
  const int64_t first = (pending != nullptr ? pending->clock : clock) - kWaveMargin;
  out << "  wave       run again with +hmlfc_checker_wave=hmlfc_checker.vcd +hmlfc_checker_first="
      << std::max<int64_t>(first, 0) << " +hmlfc_checker_last=" << clock + kWaveMargin << "\n";
  text_ += out.str();
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
  std::ostringstream out;
  out << "  more       hmlfc inspect " << stream_ << " --view " << r.row << "," << r.col
      << " --plane " << plane_name(site->plane) << " --block " << site->bx << "," << site->by
      << "\n";
  return out.str();
}

std::string Lockstep::statistics() const {
  std::ostringstream out;
  out << "hmlfc_checker: statistics of " << device_.name << " on " << stream_ << "\n";
  out << "  requests          " << requests_ << "\n";
  out << "  answers           " << answers_ << ", compared " << compared_ << "\n";
  if (dropped_ != 0) out << "  dropped by reset  " << dropped_ << "\n";
  out << "  stage records     " << records_ << ", compared " << records_compared_ << "\n";
  for (size_t i = 0; i < kStageNames.size(); ++i) {
    if (device_.stages[i]) {
      out << "    " << kStageNames[i] << std::string(16 - std::string(kStageNames[i]).size(), ' ')
          << stages_compared_[i] << "\n";
    }
  }
  if (held_ != 0)
    out << "  not shown         " << held_ << " records that the device may leave out\n";
  for (const auto& [status, count] : statuses_) {
    const bool known = status >= 0 && status < kErrorCodeCount;
    out << "  status " << status << "  " << count << "  "
        << (known ? error_name(static_cast<ErrorCode>(status)) : "not in annex A") << "\n";
  }
  show(out, "  skipped           ", skipped_);
  show(out, "  difference        ", rules_);
  out << "hmlfc_checker: "
      << (differences_ != 0 ? "FAILED: " + std::to_string(differences_) + " differences"
          : compared_ == 0  ? "FAILED: nothing was compared"
                            : "passed: " + std::to_string(compared_) + " answers are the model's")
      << "\n";
  return out.str();
}

}  // namespace hmlfc::lockstep
