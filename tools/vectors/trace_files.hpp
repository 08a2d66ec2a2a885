// Traces of chosen blocks as text (vectors/README.md, traces).
#pragma once

#include <span>
#include <string>

#include <hmlfc/decoder.hpp>

namespace hmlfc::vectors {

/// Both forms of one trace.
struct TraceText {
  std::string lines;  ///< JSON lines
  std::string hex;    ///< words for $readmemh
};

/// Every field and stage of `blocks`, which all decode, reference blocks on demand.
TraceText trace_text(const Decoder& decoder, std::span<const BlockAddress> blocks);

}  // namespace hmlfc::vectors
