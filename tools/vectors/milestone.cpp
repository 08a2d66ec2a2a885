#include "vectors/milestone.hpp"

#include <algorithm>

#include <fnmatch.h>

namespace hmlfc::vectors {

const std::vector<MilestoneRow>& milestones() {
  static const std::vector<MilestoneRow> all{
      {"jpeg-2000", "opens a stream and decodes its key images, which are its views", {}},
      {"keys", "decodes key images of every form", {"KEY-*"}},
      {"blocks", "finds tiles, decodes zero blocks and residuals", {"zero", "residual"}},
      {"motion", "decodes motion and residual reference images", {"motion"}},
      {"tree", "decodes down the tree", {"tree"}},
      {"formats",
       "decodes 4:4:4, blocks of 2 and 8, and 9 to 12 bits",
       {"chroma444", "block2", "block8", "depth9", "depth1?"}},
      {"extended", "opens profile extended without tools", {"extended"}},
      {"residual-step", "decodes with residual_step", {"residual_step"}},
      {"motion-tiles", "decodes with motion_tiles", {"motion_tiles"}},
      {"subpel-vectors", "decodes with subpel_vectors", {"subpel_vectors"}},
      {"shared-disparity", "decodes with shared_disparity", {"shared_disparity"}},
      {"two-references", "decodes with two_references", {"two_references"}},
      {"chroma-motion", "decodes with chroma_motion", {"chroma_motion"}},
      {"lossy-keys", "decodes with lossy_keys", {"lossy_keys"}},
      {"level-keys", "decodes with level_keys", {"level_keys"}},
      {"balanced-groups", "decodes with balanced_groups", {"balanced_groups"}},
      {"camera-rig", "opens streams with camera_rig", {"camera_rig"}},
      {"errors", "refuses damaged streams, and decodes the blocks that are not", {"error/*"}},
      {"limits", "decodes the largest values and sizes", {"stress/*", "performance/*"}},
  };
  return all;
}

const std::vector<MilestoneRow>& frame_milestones() {
  static const std::vector<MilestoneRow> all{
      {"records", "makes the frame records of cameras, and refuses cameras", {}},
      {"rays", "takes the nearest pixel of the nearest view", {}},
      {"plane", "blends views and pixels around a ray that meets the focal plane", {}},
      {"apertures", "blends the views of apertures 1 to 3", {}},
      {"frame-formats", "draws frames of all formats, sizes and stop levels", {}},
      {"maps", "makes disparity maps", {}},
      {"geometry", "draws frames with geometry", {}},
      {"frame-errors", "reports the errors of damaged streams, if a frame needs them", {}},
  };
  return all;
}

const std::vector<MilestoneRow>& milestones_with(std::string_view name) {
  const bool found =
      std::ranges::find(frame_milestones(), name, &MilestoneRow::name) != frame_milestones().end();
  return found ? frame_milestones() : milestones();
}

std::optional<size_t> milestone_number(std::string_view name) {
  if (name == "header") return 0;
  const auto& list = milestones_with(name);
  const auto found = std::ranges::find(list, name, &MilestoneRow::name);
  if (found == list.end()) return std::nullopt;
  return static_cast<size_t>(found - list.begin());
}

std::string milestone_of(const Vector& vector) {
  std::string_view last;
  for (const MilestoneRow& row : milestones()) {
    const auto needs = [&](std::string_view pattern) { return matches(vector, pattern); };
    if (last.empty() || std::ranges::any_of(row.needed, needs)) last = row.name;
  }
  return std::string(last);
}

bool matches(const Vector& vector, std::string_view pattern) {
  const std::string text(pattern);
  const auto fits = [&](const std::string& word) {
    return ::fnmatch(text.c_str(), word.c_str(), 0) == 0;
  };
  return fits(vector.id.text()) || fits(std::string(profile_name(vector.profile))) ||
         std::ranges::any_of(vector.clauses, fits) || std::ranges::any_of(vector.flags, fits);
}

}  // namespace hmlfc::vectors
