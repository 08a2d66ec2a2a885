// Compares the lines of a decoder with the results of the golden model.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <string>

#include "primitives/cases.hpp"

namespace hmlfc::primitives {

/// What a check found.
struct Verdict {
  uint64_t cases = 0;     ///< that had to come
  uint64_t compared = 0;  ///< lines compared
  uint64_t errors = 0;
};

/// Reads a line for each case of `request`: the inputs, then the results, separated by blanks.
/// Gives `report` one line for each error: a wrong result, a line that is not the next case's, a
/// line missing or too many. Ends after `max_errors`, and at a line out of place.
Verdict check(const Primitive& primitive, const Request& request, std::istream& lines,
              uint64_t max_errors, const std::function<void(const std::string&)>& report);

}  // namespace hmlfc::primitives
