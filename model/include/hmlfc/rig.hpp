// The rig of a stream: where the cameras of its views stand, as JSON (specification, section 12).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Content of section RIG (RIG-2): the members of its JSON text, in the ranges that stand there.
/// Entry row * cols + col of an array belongs to view (row, col); the one entry of an array of 1 to
/// all.
struct Rig {
  std::optional<double> metres_per_unit;          ///< length of a unit of positions, if known
  std::vector<std::array<double, 3>> positions;   ///< x, y, z of each camera's centre (RIG-3)
  std::vector<std::array<double, 4>> rotations;   ///< quaternions w, x, y, z (RIG-3); none: 1 0 0 0
  std::vector<std::array<double, 4>> intrinsics;  ///< fx, fy, cx, cy in pixels (RIG-4), if known

  friend bool operator==(const Rig&, const Rig&) = default;
};

/// The most bytes of the text of a rig (RIG-2).
inline constexpr size_t kMaxRigBytes = size_t{1} << 24;

/// The bytes of section RIG of `file`, a whole stream with the header `header`: a part of `file`,
/// empty without camera_rig (RIG-1). Nothing is checked: neither its crc nor its content.
HMLFC_EXPORT std::span<const uint8_t> rig_of(std::span<const uint8_t> file,
                                             const StreamHeader& header);

/// The stream `file` with `rig` as its section RIG, instead of the one that it may have; whatever
/// `rig` holds. All other sections keep their bytes. Errors: those of FIL-4; bad_feature for a
/// stream of profile main, which has no flags.
HMLFC_EXPORT Result<std::vector<uint8_t>> with_rig(std::span<const uint8_t> file,
                                                   std::span<const uint8_t> rig);

}  // namespace hmlfc
