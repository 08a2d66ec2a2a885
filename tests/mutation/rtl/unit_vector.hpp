// A conformance vector for a decode unit: what the unit is asked, and what the manifest and the
// golden model say that it must answer.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <hmlfc/decoder.hpp>

#include "check.hpp"
#include "io/files.hpp"
#include "oracle/oracle.hpp"
#include "systemc/stream_image.hpp"
#include "unit/unit_host.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::tb {

/// One vector with its stream and its reference area.
class UnitVector {
 public:
  /// Reads the stream of `vector` of the suite in `folder`. Throws std::runtime_error where it is
  /// missing.
  UnitVector(const std::filesystem::path& folder, const vectors::Vector& vector,
             const UnitParameters& unit);

  /// Whether a unit of these parameters is to be tested with it: streams within its limits, and
  /// those without a sound header, which every unit must refuse.
  static bool is_for(const UnitParameters& unit, std::span<const uint8_t> stream);

  /// LOADs the stream and asks for all pixels of all views, view by view until one is wrong. Memory
  /// and whoever takes the answers pause at times, so that the unit must hold what it has.
  /// Of the last view all planes are asked for too, where every block decodes. Expected are the
  /// error of the manifest, then the golden model's answers. A unit that does nothing for
  /// `patience` clocks hangs. `clocks` is how long it took.
  Verdict try_on(std::unique_ptr<DecodeUnit> unit, uint64_t patience, uint64_t& clocks) const;

 private:
  std::string wrong_error(unsigned error) const;
  std::string wrong_plane(UnitHost& host, Oracle& oracle, ViewPos view, unsigned plane) const;
  std::string wrong_views(UnitHost& host) const;

  vectors::Vector vector_;
  MappedFile file_;
  StreamImage image_;
  unsigned software_error_ = 0;  ///< of what the unit leaves to software (FIL-6, KEY-1)
};

}  // namespace hmlfc::tb
