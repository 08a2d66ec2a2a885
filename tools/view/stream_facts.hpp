// What the page has to know of the stream before it asks for anything else.
#pragma once

#include "cli/output.hpp"
#include "view/open_stream.hpp"

namespace hmlfc::view {

/// Name, error and warning; of a stream that opens also its shape, coding, tools, levels as
/// `info --json` has them, what geometry suits it, the disparities of the middle view, and whether
/// there is an original.
cli::Json stream_facts(const OpenStream& stream);

/// What `info --json` says, without disparities, and ImageBytes as "images", without bytes by image
/// for levels of over kMostListedImages images; reads every tile. Failure (kCorrupt).
cli::Json stream_totals(const OpenStream& stream);

}  // namespace hmlfc::view
