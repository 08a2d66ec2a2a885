// Input of the part of the motion search that depends on the instruction set. It has plain values
// and no templates: code that is compiled for several instruction sets must not instantiate what
// other files share, or the linker may keep the copy that needs the newest processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "encoder/motion_search.hpp"

namespace hmlfc {

/// One call of search_motion(), its arguments checked.
struct MotionRequest {
  const int16_t* block;      ///< block_size^2 samples, row-major
  const int16_t* reference;  ///< the reference sample at the block's position
  ptrdiff_t stride;
  int block_size;  ///< 2, 4 or 8
  int window;      ///< [0, 127]
  bool both_signs;
  const MotionMatch* hints;
  size_t hint_count;
};

/// The first candidate so far.
class MotionBest {
 public:
  /// Whether there is one.
  bool found() const { return match_.sad != kNone; }

  const MotionMatch& match() const { return match_; }

  void offer(const MotionMatch& match) {
    if (precedes(match, match_)) {
      match_ = match;
      length_ = std::abs(int{match.dx}) + std::abs(int{match.dy});
    }
  }

  /// A candidate with |dx| + |dy| >= least_length cannot precede match() if its sad is larger than
  /// this, -1 or more: match().sad, or one less where such a candidate loses every tie.
  int64_t limit(int least_length) const {
    const bool loses_ties = !match_.negative && least_length > length_;
    return int64_t{match_.sad} - (loses_ties ? 1 : 0);
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  MotionMatch match_{.sad = kNone};
  int length_ = 0;
};

}  // namespace hmlfc
