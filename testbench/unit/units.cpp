#include "unit/units.hpp"

#include "syntax/header.hpp"

namespace hmlfc::tb {

const UnitMaker* unit_for(const std::vector<UnitMaker>& makers, std::span<const uint8_t> stream) {
  if (makers.empty()) return nullptr;
  const auto header = parse_header(stream);
  const UnitMaker* maker = header ? unit_for(makers, header->block_log2, header->depth) : nullptr;
  return maker != nullptr ? maker : &makers.front();
}

}  // namespace hmlfc::tb
