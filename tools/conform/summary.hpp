// Where to begin with a decoder's failures: milestones, clauses, one vector, probable causes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "conform/result.hpp"

namespace hmlfc::conform {

/// The vectors of one milestone (tools/vectors/milestone.hpp).
struct MilestoneCount {
  std::string name;
  std::string claim;
  size_t claimed = 0;  ///< vectors that are required of the decoder
  size_t pass = 0;
  size_t skipped = 0;
  size_t bad = 0;  ///< failures that are not waived

  bool whole() const { return pass == claimed; }
};

/// Failures that probably have one cause.
struct Cause {
  std::string text;
  std::vector<const VectorResult*> results;  ///< the simplest first: by milestone, then by bytes
};

/// What a report of one decoder begins with. Points into the run.
struct Summary {
  std::vector<MilestoneCount> milestones;  ///< in their order
  /// The first milestone with a failure that is not waived, or null.
  const MilestoneCount* first = nullptr;
  /// Clauses of which every vector that was run fails, by the milestone in which they begin.
  std::vector<std::string> clauses;
  /// The vector to look at first: the smallest failure of milestone `first`, or null.
  const VectorResult* look_at = nullptr;
  std::vector<Cause> causes;  ///< of failures that are not waived, the largest first
};

/// Failures have one cause if they have the same first wrong stage and clause; or if samples are
/// wrong without a stage, and the same clause is the most suspect of those that they exercise (the
/// one with the greatest share of failures, then with the most), or no other vector fails with
/// these clauses and the same planes are wrong; or the same message but for numbers.
Summary summarise(const Run& run);

}  // namespace hmlfc::conform
