#include "unit/units.hpp"

#include <algorithm>

namespace hmlfc::tb {

const UnitMaker* unit_for(const std::vector<UnitMaker>& makers, unsigned block_log2, int depth) {
  const auto found = std::ranges::find_if(makers, [&](const UnitMaker& maker) {
    return maker.parameters.block_log2 == block_log2 &&
           depth <= static_cast<int>(maker.parameters.max_depth);
  });
  return found == makers.end() ? nullptr : &*found;
}

}  // namespace hmlfc::tb
