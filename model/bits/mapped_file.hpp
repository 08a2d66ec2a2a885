// A file mapped to memory for reading (POSIX).
#pragma once

#include <cstdint>
#include <span>

#include <tl/expected.hpp>

#include <hmlfc/byte_source.hpp>

namespace hmlfc {

/// Why a file is not mapped.
struct MapFailure {
  const char* reason = "";  ///< what could not be done, a line without full stop
  int system_error = 0;     ///< errno, or 0 where it says nothing
};

/// Read-only view of a whole regular file for the lifetime of the object. The file must not be
/// shortened meanwhile (the system would kill the process); replacing it by rename is safe.
class MappedFile final : public ByteSource {
 public:
  /// Errors: the file does not exist, cannot be read, or is not a regular file.
  static tl::expected<MappedFile, MapFailure> open(const char* path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile() override;

  /// Takes the pages read so far out of memory; they are read again when they are needed.
  void drop_pages() const;

  /// All bytes of the file; an empty span for an empty file.
  std::span<const uint8_t> bytes() const override { return bytes_; }

 private:
  explicit MappedFile(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  std::span<const uint8_t> bytes_;
};

}  // namespace hmlfc
