// What must find mutants: conformance vectors, and tests of the bench.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hmlfc::tb {

/// What a check says of a unit.
struct Verdict {
  bool hangs = false;
  std::string difference;  ///< from what is expected; empty for none

  bool pass() const { return difference.empty(); }
};

/// One check, of whatever mutants are switched on (mutants_plusarg()).
class Check {
 public:
  virtual ~Check() = default;

  virtual const std::string& id() const = 0;

  /// How long it takes, in an order: small first.
  virtual uint64_t size() const = 0;

  /// The verdict, and the clocks that it took.
  virtual Verdict run(uint64_t& clocks) = 0;
};

/// The vectors of the suite in a folder for the first unit of rtl_units(). Throws
/// std::runtime_error where the suite is damaged.
std::vector<std::unique_ptr<Check>> vector_checks(const std::filesystem::path& suite);

/// The tests of GoogleTest that this program is linked with, of suites with `part` in their names,
/// each in a process of its own; one that takes far longer than it did when it passed hangs, and
/// one that has not passed yet after 60 s of CPU time.
std::vector<std::unique_ptr<Check>> test_checks(std::string_view part);

}  // namespace hmlfc::tb
