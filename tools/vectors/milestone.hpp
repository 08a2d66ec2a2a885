// The order in which a decoder or a renderer grows: each vector belongs to one milestone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// One step of the table in milestone.cpp, which is the only place that defines them.
struct MilestoneRow {
  std::string_view name;
  std::string_view claim;  ///< what a decoder can do whose vectors of it pass
  std::vector<std::string_view>
      needed;  ///< patterns of matches(); any of them: the vector needs it
};

/// All milestones of decoders in their order. The first needs nothing.
const std::vector<MilestoneRow>& milestones();

/// All milestones of renderers in their order, which recipes of frames name.
const std::vector<MilestoneRow>& frame_milestones();

/// The list that has the milestone `name`; that of decoders if none has it.
const std::vector<MilestoneRow>& milestones_with(std::string_view name);

/// The number in its list of the milestone with this name, or nothing. Suites before 3.3.1 call the
/// first one "header".
std::optional<size_t> milestone_number(std::string_view name);

/// The first milestone at which all that `vector` needs is there: the last one that it needs.
std::string milestone_of(const Vector& vector);

/// Whether a pattern with * and ? matches the vector's id, profile, one of its clauses or flags.
bool matches(const Vector& vector, std::string_view pattern);

}  // namespace hmlfc::vectors
