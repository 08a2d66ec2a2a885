// What a decode unit is built for, a request to it and its answer (docs/decode_unit.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc::tb {

/// The plane number that asks for pixels in RGB.
inline constexpr unsigned kRgb = 3;

/// Samples of the largest answer: three lanes of 8 x 8.
inline constexpr size_t kMaxLaneSamples = 64;
inline constexpr size_t kLanes = 3;

/// The parameters of a unit.
struct UnitParameters {
  unsigned block_log2 = 2;
  unsigned max_depth = 8;
  unsigned beat_bytes = 16;
  unsigned outstanding = 16;  ///< maximum of bursts in flight
  uint32_t state_seed = 1;    ///< draws what a simulated unit holds before reset; [1, 2^31 - 1]

  unsigned block_size() const { return 1u << block_log2; }

  /// The same, with a state for a run by `seed`.
  UnitParameters with_state(uint64_t seed) const {
    UnitParameters other = *this;
    other.state_seed = static_cast<uint32_t>(seed % 0x7fffffff) + 1;
    return other;
  }
};

/// The status of a block that needs a beat which the memory failed to deliver.
inline constexpr auto kBusError = static_cast<uint8_t>(ErrorCode::kBusError);

/// The name of status `status` in [0, 63]; "unknown" for numbers that name no error.
inline std::string status_name(unsigned status) {
  if (status >= static_cast<unsigned>(kErrorCodeCount)) return "unknown";
  return std::string(error_name(static_cast<ErrorCode>(status)));
}

/// One beat of the request channel. The fields have the widths of `tdata`.
struct Request {
  uint32_t row = 0;         ///< 12 bits
  uint32_t col = 0;         ///< 12 bits
  uint32_t bx = 0;          ///< 15 bits
  uint32_t by = 0;          ///< 15 bits
  unsigned plane = 0;       ///< 0 Y, 1 Co, 2 Cg, 3 RGB
  unsigned stop_level = 0;  ///< 4 bits
  bool last = false;
  bool residuals = false;  ///< of the reference image at the stop level

  /// `tdata`.
  uint64_t word() const {
    return uint64_t{row} | uint64_t{col} << 12 | uint64_t{bx} << 24 | uint64_t{by} << 39 |
           uint64_t{plane} << 54 | uint64_t{stop_level} << 56 | uint64_t{residuals} << 60;
  }

  static Request of_word(uint64_t word, bool last) {
    const auto field = [&](unsigned at, unsigned bits) {
      return static_cast<uint32_t>(word >> at & ((uint64_t{1} << bits) - 1));
    };
    return {field(0, 12), field(12, 12), field(24, 15), field(39, 15),
            field(54, 2), field(56, 4),  last,          field(60, 1) != 0};
  }

  friend bool operator==(const Request&, const Request&) = default;
};

/// Gives the next request, or nothing when there is none left.
using RequestSource = std::function<std::optional<Request>()>;

/// "Y", "Co", "Cg" or "RGB".
inline std::string plane_text(unsigned plane) {
  return plane == kRgb ? "RGB" : std::string(plane_name(static_cast<Plane>(plane)));
}

/// "view 3,4 plane RGB block 12,7 stop level 0".
inline std::string to_string(const Request& request) {
  return "view " + std::to_string(request.row) + "," + std::to_string(request.col) + " plane " +
         plane_text(request.plane) + " block " + std::to_string(request.bx) + "," +
         std::to_string(request.by) + " stop level " + std::to_string(request.stop_level) +
         (request.residuals ? " residuals" : "");
}

/// One beat of the answer channel; lane c has samples [c * B * B, (c + 1) * B * B - 1].
struct Answer {
  uint8_t status = 0;  ///< `tuser`
  bool last = false;
  std::array<int16_t, kLanes * kMaxLaneSamples> samples{};
};

}  // namespace hmlfc::tb
