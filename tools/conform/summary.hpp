// Where to begin with a decoder's failures: milestones, clauses, one vector, probable causes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "conform/result.hpp"

namespace hmlfc::conform {

/// How vectors that belong together stand.
struct Count {
  size_t vectors = 0;  ///< all of them
  size_t claimed = 0;  ///< that are required of the decoder
  size_t pass = 0;
  size_t skipped = 0;
  size_t bad = 0;  ///< failures that are not waived

  void add(const VectorResult& result);
  bool whole() const { return pass == claimed; }
};

/// The vectors of one milestone (tools/vectors/milestone.hpp).
struct MilestoneCount : Count {
  std::string name{};
  std::string claim{};
};

/// Failures that probably have one cause.
struct Cause {
  std::string text;
  /// The simplest first: by milestone, those that are telling, then by bytes.
  std::vector<const VectorResult*> results;
};

/// What a report of one decoder begins with. Points into the run.
struct Summary {
  std::vector<MilestoneCount> milestones;  ///< in their order
  /// The first milestone with a failure that is not waived, or null.
  const MilestoneCount* first = nullptr;
  /// Clauses that begin with milestone `first` and of which every vector that was run fails, those
  /// of most vectors first. General ones are left out if there are others.
  std::vector<std::string> clauses;
  /// The vector to look at first: the simplest failure of milestone `first`, or null.
  const VectorResult* look_at = nullptr;
  /// Of failures that are not waived, the largest first; refusals that do not count are the last.
  std::vector<Cause> causes;
  /// Of the milestones that the decoder claims, the one after the only one to be run, or null.
  const MilestoneCount* next = nullptr;
};

/// Failures have one cause if they have the same first wrong stage and clause; else if the same
/// planes are wrong; or the same kind; or the same reason but for numbers. General clauses say what
/// a stream and a decoder are (BND, CNV, LVL, STR), not what is done for a block.
Summary summarise(const Run& run);

}  // namespace hmlfc::conform
