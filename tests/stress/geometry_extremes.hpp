// Image and tile numbers of trees that no file can hold.
#pragma once

#include "width_record.hpp"

namespace hmlfc::stress {

/// What the numbers of the last image and its last tile reach (IDX-1, IDX-2): the largest grid in
/// the most levels, with views as large as they get. The index of such a stream would take more
/// than 7 * 10^12 bytes, so only the arithmetic is run.
Ranges geometry_extremes();

}  // namespace hmlfc::stress
