// Where the bytes of a stream come from: memory, a mapped file, or a place that loads them when
// they are needed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <hmlfc/export.hpp>

namespace hmlfc {

/// Bytes [offset, offset + bytes) of a file.
struct ByteRange {
  uint64_t offset = 0;  ///< from the start of the file
  uint64_t bytes = 0;   ///< how many

  friend bool operator==(const ByteRange&, const ByteRange&) = default;
};

/// The bytes of one file. Several threads call it at once.
///
/// A source whose bytes are all in memory defines bytes() alone. A *partial* source loads them: a
/// decoder calls load() before it reads, and reads nothing that was not loaded.
class HMLFC_EXPORT ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// The file, at one place as long as the source lives. Of a partial source, bytes that are not
  /// loaded may be read, but have no meaning.
  virtual std::span<const uint8_t> bytes() const = 0;

  /// Whether bytes must be loaded. Only then are the functions below called.
  virtual bool is_partial() const { return false; }

  /// Whether all bytes of `range`, which lies in the file, are loaded.
  virtual bool holds(ByteRange range) const {
    static_cast<void>(range);
    return true;
  }

  /// Loads all bytes of `ranges`, which lie in the file, in any order; they stay until the request
  /// ends. Returns whether all are loaded; once false, it stays false.
  virtual bool load(std::span<const ByteRange> ranges) {
    static_cast<void>(ranges);
    return true;
  }

  /// A decoder begins to answer a request. Requests nest, and overlap in several threads.
  virtual void begin_request() {}

  /// A request ends; while there is none, the source may drop bytes.
  virtual void end_request() {}

  /// Why load() failed, a line for people; empty while it has not. A request during which this is
  /// not empty ends with bus_error.
  virtual std::string failure() const { return {}; }
};

/// Bytes in memory, which must outlive the source.
class MemorySource final : public ByteSource {
 public:
  /// The file `bytes`, as they stay.
  explicit MemorySource(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  std::span<const uint8_t> bytes() const override { return bytes_; }

 private:
  std::span<const uint8_t> bytes_;
};

}  // namespace hmlfc
