// A stream whose header has been checked: its bytes, header and geometry.
#pragma once

#include <cstdint>
#include <span>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/read_sink.hpp>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// Borrowed bytes of a whole file with what its header says. Immutable.
struct StreamView {
  std::span<const uint8_t> file;
  StreamHeader header;
  Geometry geometry;
  ReadSink* reads = nullptr;

  const SectionEntry& entry(Section section) const {
    if (section == Section::kRig) return header.rig;
    return header.sections[static_cast<size_t>(section) - 1];
  }

  /// The bytes of TOP, ROOT, GROUP, TILE or RIG; of RIG none without camera_rig.
  std::span<const uint8_t> bytes(Section section) const {
    const SectionEntry& e = entry(section);
    return file.subspan(static_cast<size_t>(e.offset), static_cast<size_t>(e.size));
  }

  /// Notifies the read sink, if any, that `bytes` bytes from `offset` of `section` are read.
  void note_read(Section section, uint64_t offset, uint64_t bytes) const {
    if (reads != nullptr) reads->on_read(entry(section).offset + offset, bytes);
  }

  /// An error at byte `offset` of `section`.
  tl::unexpected<Error> error(ErrorCode code, Section section, uint64_t offset) const {
    return fail(code, section, entry(section).offset + offset);
  }
};

}  // namespace hmlfc
