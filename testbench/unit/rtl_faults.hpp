// Faults in the RTL itself, which the bench must find: rtl_faults.cmake plants them in a copy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// One fault.
struct RtlFault {
  unsigned number;  ///< from 1 on
  std::string name;
  std::string module;  ///< the file it is in
  std::string rule;    ///< how the finding must begin
  uint32_t seed;       ///< of the stream to try first
};

/// The parameters of the unit with the faults.
inline constexpr UnitParameters kFaultyUnit{1, 12, 8, 4};

const std::vector<RtlFault>& rtl_faults();

/// The unit with one fault switched on, with 0 none; `parameters` are kFaultyUnit but for the
/// state.
std::unique_ptr<DecodeUnit> make_faulty_unit(const UnitParameters& parameters, unsigned fault);

}  // namespace hmlfc::tb
