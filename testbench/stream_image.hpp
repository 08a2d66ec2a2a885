// One stream ready to be checked: its bytes, the golden model's view of it and its reference area.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench.hpp"
#include "oracle.hpp"
#include "reference_area.hpp"

namespace hmlfc::tb {

/// Borrowed bytes of a stream with everything that a run needs. A stream that LOAD must refuse has
/// no golden stream and an empty area.
class StreamImage {
 public:
  StreamImage(std::span<const uint8_t> bytes, const UnitParameters& unit);

  /// The error that LOAD must end with, 0 for none.
  uint8_t load_error() const { return load_error_; }

  /// Null where LOAD fails.
  const GoldenStream* golden() const { return golden_.get(); }
  const ReferenceArea& area() const { return area_; }
  Oracle& oracle() { return *oracle_; }

  MemoryImage memory() const;

  /// Puts the image into the memory of `bench`, LOADs it and checks STATUS.
  void load_into(Bench& bench) const;

 private:
  std::span<const uint8_t> bytes_;
  uint8_t load_error_ = 0;
  std::unique_ptr<GoldenStream> golden_;
  ReferenceArea area_;
  std::unique_ptr<Oracle> oracle_;
};

}  // namespace hmlfc::tb
