// The named errors of the specification (annex A) and the result type that carries them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include <hmlfc/export.hpp>

namespace hmlfc {

/// One value for each normative rejection; the numbers are those of annex A.
enum class ErrorCode : uint8_t {
  kOk = 0,
  kTruncated = 1,
  kBadMagic = 2,
  kBadVersion = 3,
  kBadHeaderCrc = 4,
  kBadProfile = 5,
  kBadFeature = 6,
  kBadHeaderField = 7,
  kBadSectionTable = 8,
  kTrailingBytes = 9,
  kBadSectionCrc = 10,
  kBadSectionSize = 11,
  kBadTopEntry = 12,
  kBadTopImage = 13,
  kBadTopCrc = 14,
  kTopSampleRange = 15,
  kBadRootEntry = 16,
  kBadGroupRecord = 17,
  kBadTileOffset = 18,
  kTileOverrun = 19,
  kMaskOutside = 20,
  kBadMode = 21,
  kBadLevels = 22,
  kVectorRange = 23,
  kLimitExceeded = 24,
  kBadRequest = 25,
  kOutOfMemory = 26,
  kBusError = 27,
};

inline constexpr int kErrorCodeCount = 28;

/// Where in the file an error was found. The values 1 to 5 are the section types of FIL-3.
enum class Section : uint8_t { kHeader = 0, kTop = 1, kRoot = 2, kGroup = 3, kTile = 4, kRig = 5 };

/// An error and where it was found.
struct Error {
  ErrorCode code = ErrorCode::kOk;     ///< the rejection
  Section section = Section::kHeader;  ///< where it was found
  uint64_t offset = 0;                 ///< byte offset from the start of the file
};

/// The name of annex A, such as "bad_magic".
HMLFC_EXPORT std::string_view error_name(ErrorCode code);

/// The meaning of annex A, one line without full stop.
HMLFC_EXPORT std::string_view error_meaning(ErrorCode code);

/// "header", "TOP", "ROOT", "GROUP", "TILE" or "RIG".
HMLFC_EXPORT std::string_view section_name(Section section);

/// One line for people: "bad_levels in TILE at byte 1234: a level code beyond ...".
HMLFC_EXPORT std::string to_string(const Error& error);

/// A value, or the error that stands for it.
template <class T>
using Result = tl::expected<T, Error>;

/// A failed result.
inline tl::unexpected<Error> fail(ErrorCode code, Section section, uint64_t offset) {
  return tl::unexpected<Error>(Error{code, section, offset});
}

}  // namespace hmlfc
