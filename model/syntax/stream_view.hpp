// A stream whose header has been checked: its bytes, header and geometry.
#pragma once

#include <cstdint>
#include <span>

#include <hmlfc/byte_source.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/read_sink.hpp>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// Loads `range` where it is missing. Returns whether it can be read.
inline bool is_loaded(ByteSource& source, ByteRange range) {
  return source.holds(range) || source.load({&range, 1});
}

/// Borrowed bytes of a whole file with what its header says. Immutable.
struct StreamView {
  std::span<const uint8_t> file;
  StreamHeader header;
  Geometry geometry;
  ReadSink* reads = nullptr;
  ByteSource* source = nullptr;           ///< of `file`, where it is partial
  uint64_t max_code_blocks = UINT64_MAX;  ///< DecoderLimits

  const SectionEntry& entry(Section section) const {
    if (section == Section::kRig) return header.rig;
    return header.sections[static_cast<size_t>(section) - 1];
  }

  /// The bytes of TOP, ROOT, GROUP, TILE or RIG; of RIG none without camera_rig.
  std::span<const uint8_t> bytes(Section section) const {
    const SectionEntry& e = entry(section);
    return file.subspan(static_cast<size_t>(e.offset), static_cast<size_t>(e.size));
  }

  /// Reads `bytes` bytes from `offset` of `section`, in which they lie: reports them to `reads`, if
  /// there is one, and loads what a partial source lacks. Errors: bus_error, at `offset`, where the
  /// source does not give them.
  Result<std::span<const uint8_t>> read(Section section, uint64_t offset, uint64_t bytes) const {
    const ByteRange range{entry(section).offset + offset, bytes};
    if ((reads != nullptr || source != nullptr) && !fetch(range)) {
      return error(ErrorCode::kBusError, section, offset);
    }
    return file.subspan(static_cast<size_t>(range.offset), static_cast<size_t>(bytes));
  }

  /// An error at byte `offset` of `section`.
  tl::unexpected<Error> error(ErrorCode code, Section section, uint64_t offset) const {
    return fail(code, section, entry(section).offset + offset);
  }

 private:
  bool fetch(ByteRange range) const;
};

}  // namespace hmlfc
