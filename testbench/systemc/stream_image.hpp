// One stream ready to be checked: its bytes, the golden model's view of it and its reference area.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "oracle/reference_area.hpp"
#include "systemc/bench.hpp"

namespace hmlfc::tb {

/// Borrowed bytes of a stream with everything that a run needs. A stream that LOAD must refuse, or
/// software for its TOP table, has no golden stream and an empty area.
class StreamImage {
 public:
  StreamImage(std::span<const uint8_t> bytes, const UnitParameters& unit);

  /// The error of the stream, 0 for none; LOAD must end with it, unless left_to_software().
  uint8_t load_error() const { return load_error_; }

  /// Whether LOAD takes the stream, and software must not, for its TOP table (KEY-1). Nothing can
  /// be asked of it.
  bool left_to_software() const { return left_to_software_; }

  /// Null where the stream is refused.
  const GoldenStream* golden() const { return golden_.get(); }
  const ReferenceArea& area() const { return area_; }
  Oracle& oracle() { return *oracle_; }

  MemoryImage memory() const;

  /// Puts the image into the memory of `bench`, LOADs it and checks STATUS.
  void load_into(Bench& bench) const;

 private:
  std::span<const uint8_t> bytes_;
  uint8_t load_error_ = 0;
  bool left_to_software_ = false;
  std::unique_ptr<GoldenStream> golden_;
  ReferenceArea area_;
  std::unique_ptr<Oracle> oracle_;
};

}  // namespace hmlfc::tb
