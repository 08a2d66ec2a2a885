#include "cli/block_trace.hpp"

#include <algorithm>

namespace hmlfc::cli {

const TracedWalk* TracedLevel::own_walk() const {
  const auto found = std::ranges::find(walks, site, &TracedWalk::site);
  return found == walks.end() ? nullptr : &*found;
}

const TracedWalk* TracedLevel::walk(TileKind kind) const {
  const auto found =
      std::ranges::find(walks, kind, [](const TracedWalk& walk) { return walk.site.tile; });
  return found == walks.end() ? nullptr : &*found;
}

bool TracedLevel::is_reference(const TracedWalk& walk) const {
  return walk.site.tile == TileKind::kResidual && walk.site != site;
}

const TracedStage* TracedLevel::stage(std::string_view name) const {
  const auto found = std::ranges::find(stages, name, &TracedStage::name);
  return found == stages.end() ? nullptr : &*found;
}

BlockState TracedLevel::state() const {
  const bool residual = stage("residual") != nullptr;
  if (stage("reference") != nullptr) {
    return residual ? BlockState::kMotionResidual : BlockState::kMotion;
  }
  return residual ? BlockState::kResidual : BlockState::kZero;
}

TracedLevel& BlockTrace::level_of(const BlockSite& site) {
  if (levels_.empty() || levels_.back().site.level != site.level) {
    BlockSite own = site;
    own.tile = TileKind::kResidual;
    levels_.push_back({own, {}, {}});
  }
  return levels_.back();
}

void BlockTrace::on_field(const FieldRecord& record) {
  TracedLevel& level = level_of(record.site);
  if (level.walks.empty() || level.walks.back().site != record.site) {
    level.walks.push_back({record.site, {}});
  }
  level.walks.back().fields.push_back({record.section, record.bit, record.bits,
                                       std::string(record.name), std::string(record.clause),
                                       record.value});
}

void BlockTrace::on_stage(const StageRecord& record) {
  level_of(record.site)
      .stages.push_back({std::string(record.stage),
                         std::string(record.clause),
                         {record.values.begin(), record.values.end()}});
}

}  // namespace hmlfc::cli
