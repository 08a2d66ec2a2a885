// The bytes of a stream and of its reference area that the answer to a request depends on.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "oracle/golden_stream.hpp"
#include "oracle/reference_area.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {

/// Bytes [begin, end) of the stream, or of the reference area.
struct ByteRange {
  bool in_area = false;
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// What the walks of the golden model read for a block, and the strips of its references. A unit
/// reads the same, in whole beats: 16 bytes of the end table, and whole records and strips.
class BlockReads {
 public:
  /// `stream` must outlive it.
  explicit BlockReads(const GoldenStream& stream);

  /// For every block of a level that the request takes, up to the first that does not decode by
  /// its records; none for a request that is refused.
  std::vector<ByteRange> of(const Request& request) const;

 private:
  void add_plane(const Request& request, Plane plane, std::vector<ByteRange>& ranges) const;
  bool add_level(const BlockSite& site, std::vector<ByteRange>& ranges) const;
  void add_window(const BlockSite& site, const ReferenceMotion& motion,
                  std::vector<ByteRange>& ranges) const;
  void add_strips(const BlockSite& site, uint32_t last_bx, uint32_t last_by,
                  std::vector<ByteRange>& ranges) const;

  const GoldenStream& stream_;
  std::map<std::tuple<int, uint32_t, uint32_t>, uint64_t> images_;  // first byte in the area
};

}  // namespace hmlfc::tb
