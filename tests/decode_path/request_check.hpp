// Requests of callers: parts of views, and what is not there.
#pragma once

#include <hmlfc/decoder.hpp>

namespace hmlfc::vectors {

/// Checks that `decoder` refuses blocks, parts, levels and refinements that its stream does not
/// have, and that a part of a view is that part of it. Throws Mismatch.
void check_requests(const Decoder& decoder);

}  // namespace hmlfc::vectors
