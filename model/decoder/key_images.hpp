// The key images of the TOP section (KEY-1 to KEY-4, EXT-6).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>

#include "arithmetic/widths.hpp"
#include "decoder/lazy_map.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Bytes of one entry of the TOP table (KEY-1).
inline constexpr uint64_t kTopEntryBytes = 16;

/// CRC-32C of samples as KEY-3 writes them.
uint32_t sample_crc(const SamplePlane& plane);

/// Clamps what loss has moved out of `range` (EXT-6).
void clamp_samples(SamplePlane& plane, const SampleRange& range);

/// Bytes of the codestream of plane `plane` of key image number `key` (KEY-1). The table has passed
/// check_top_table. Errors: bus_error; bad_top_entry where the entry has changed since.
Result<uint64_t> codestream_bytes(const StreamView& stream, uint64_t key, Plane plane);

/// Checks the whole TOP table (KEY-1): bad_section_size, bad_top_entry.
Result<void> check_top_table(const StreamView& stream);

/// Planes of key images that are needed and not decoded yet.
class KeyRequests {
 public:
  bool empty() const { return entries_.empty(); }

 private:
  friend class KeyImages;
  std::vector<uint64_t> entries_;  // of the TOP table
};

/// Decodes planes of key images on first use and keeps them. A plane is always decoded whole: its
/// errors are those of all its samples (KEY-3). Thread-safe.
class KeyImages {
 public:
  explicit KeyImages(const StreamView& stream) : stream_(stream) {}

  /// Plane `plane` of key image `at` of keyed level `level`. Its table has passed check_top_table.
  /// Errors: bad_top_image, limit_exceeded (DecoderLimits::max_code_blocks), bad_top_crc,
  /// top_sample_range; bus_error; bad_top_entry where a partial source gave another entry than at
  /// first.
  Result<std::shared_ptr<const SamplePlane>> plane(int level, ImagePos at, Plane plane) const;

  /// Returns a plane that is held. Another is not decoded: it is added to `requests`, and a
  /// plane of zeros is returned.
  std::shared_ptr<const SamplePlane> plane_or_request(int level, ImagePos at, Plane plane,
                                                      KeyRequests& requests) const;

  /// Loads the codestream of a plane, unless the plane is held, as far as the source of `stream`
  /// can.
  void load(const StreamView& stream, int level, ImagePos at, Plane plane) const;

  /// Decodes the planes of all `requests`, each once, on all threads of the caller's
  /// run_on_threads(). A plane that does not decode has its error when plane() is called.
  void decode(std::span<const KeyRequests> requests) const;

 private:
  uint64_t entry_of(int level, ImagePos at, Plane plane) const;
  Result<std::shared_ptr<const SamplePlane>> plane(uint64_t entry) const;
  Result<SamplePlane> decode(uint64_t entry) const;

  const StreamView& stream_;
  mutable LazyMap<SamplePlane> planes_;  // by entry
  mutable LazyMap<SamplePlane> zeros_;   // by Plane
};

}  // namespace hmlfc
