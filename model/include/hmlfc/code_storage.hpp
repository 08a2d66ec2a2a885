// Where an encoder of bounded memory keeps what it has coded.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <hmlfc/export.hpp>

namespace hmlfc {

/// Bytes that grow at the end and are read anywhere: a temporary file, say. What its functions throw
/// reaches the caller of the encoder.
class HMLFC_EXPORT CodeStorage {
 public:
  virtual ~CodeStorage() = default;

  /// Appends `bytes`; returns where they begin. Called by several threads at once.
  virtual uint64_t append(std::span<const uint8_t> bytes) = 0;

  /// Fills `out` with the bytes from `offset` on, which were appended.
  virtual void read(uint64_t offset, std::span<uint8_t> out) const = 0;
};

/// Takes the next bytes of a stream.
using ByteSink = std::function<void(std::span<const uint8_t> bytes)>;

}  // namespace hmlfc
