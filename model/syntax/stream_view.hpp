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

  /// Whether reads have to be announced.
  bool is_watched() const { return reads != nullptr || source != nullptr; }

  /// Comes before each read of `bytes` bytes from `offset` of `section`: notifies the read sink, if
  /// any, and loads them. False: they cannot be read, which is unread().
  bool will_read(Section section, uint64_t offset, uint64_t bytes) const {
    return !is_watched() || announce({entry(section).offset + offset, bytes});
  }

  /// The error of bytes of `section` that the source of the stream does not give.
  tl::unexpected<Error> unread(Section section, uint64_t offset) const {
    return error(ErrorCode::kBusError, section, offset);
  }

  /// An error at byte `offset` of `section`.
  tl::unexpected<Error> error(ErrorCode code, Section section, uint64_t offset) const {
    return fail(code, section, entry(section).offset + offset);
  }

 private:
  bool announce(ByteRange range) const;
};

}  // namespace hmlfc
