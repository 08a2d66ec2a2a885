// Tests of fast paths on each instruction set of this machine that they are compiled for.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hmlfc::test {

/// While it lives, dynamic dispatch takes `target`, one of instruction_sets().
class ChosenInstructionSet {
 public:
  explicit ChosenInstructionSet(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ChosenInstructionSet(const ChosenInstructionSet&) = delete;
  ChosenInstructionSet& operator=(const ChosenInstructionSet&) = delete;
  ~ChosenInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
};

/// Highway's numbers of those of this machine.
inline std::vector<int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

/// "AVX2".
inline std::string instruction_set_name(int64_t target) { return hwy::TargetName(target); }

}  // namespace hmlfc::test
