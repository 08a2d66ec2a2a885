// Light fields that are encoded part by part: in bounded memory, or on several machines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include <hmlfc/code_storage.hpp>
#include <hmlfc/encoder.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/view_provider.hpp>

namespace hmlfc {

/// A grid of views cut into parts, numbered row by row.
struct PartGrid {
  std::vector<uint32_t> row_ends;  ///< ascending; the last is the number of view rows
  std::vector<uint32_t> col_ends;  ///< likewise of columns

  /// How many parts.
  size_t count() const { return row_ends.size() * col_ends.size(); }

  friend bool operator==(const PartGrid&, const PartGrid&) = default;
};

/// How a light field is divided.
struct Division {
  /// Bytes that the encoder may hold, in addition to its own program and about a kilobyte a view;
  /// sets the parts, and fewer threads where it must. None: all that is needed.
  std::optional<uint64_t> memory;
  /// The parts, for a light field that was divided before. None: as `memory` says, or without it
  /// small ones, for machines to share.
  std::optional<PartGrid> parts;
};

/// Encodes a light field in parts, each with all that it depends on, so that encode() would give
/// the same bytes whatever the division, the order of parts and the machines.
///
///   auto encoder = DividedEncoder::create(views, params, {.memory = 512 << 20}, storage);
///   for (size_t part = 0; part < encoder->parts().count(); ++part) encoder->encode_part(part);
///   encoder->write({}, sink);
///
/// One thread may use it, which it makes threads of. After an error it may only be destroyed.
class HMLFC_EXPORT DividedEncoder {
 public:
  /// Settles `params` and the division; both are then known. `views` and `storage` must outlive the
  /// encoder. Errors: those of encode(), a bound too small for one view (the least that would do is
  /// named), parts that do not make up the grid.
  static tl::expected<DividedEncoder, EncodeError> create(const ViewProvider& views,
                                                          const EncodeParams& params,
                                                          const Division& division,
                                                          CodeStorage& storage);

  /// The encoder moved from may only be assigned to or destroyed.
  DividedEncoder(DividedEncoder&&) noexcept;
  /// The encoder moved from may only be assigned to or destroyed.
  DividedEncoder& operator=(DividedEncoder&&) noexcept;
  ~DividedEncoder();

  const EncodeParams& params() const;  ///< nothing is open
  const PartGrid& parts() const;       ///< the division
  int threads() const;                 ///< that the parts are coded on
  const StreamHeader& header() const;  ///< without its section table
  const ErrorSums& error() const;      ///< of the parts so far

  /// Codes part `part` in [0, parts().count() - 1]. `progress` counts images of all parts. Error:
  /// out of memory.
  tl::expected<void, EncodeError> encode_part(size_t part, const Progress& progress = {});

  /// Hands to `sink` what load_part() needs of a part that was coded.
  void save_part(size_t part, const ByteSink& sink) const;

  /// Takes over a part that save_part() wrote from an encoder made with the same views, settled
  /// params() and parts(); `error` is that of the part. False: `bytes` are not of this part.
  bool load_part(size_t part, std::span<const uint8_t> bytes, const ErrorSums& error);

  /// Hands the whole stream to `sink`, with all parts coded or loaded. `rig`: the section RIG, made
  /// for the stream's header; empty for none.
  void write(std::span<const uint8_t> rig, const ByteSink& sink) const;

 private:
  struct State;
  explicit DividedEncoder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc
