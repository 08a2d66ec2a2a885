// What the view unit writes to memory, against the golden model; no SystemC.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "view/expected_view.hpp"
#include "view/view_host.hpp"

namespace hmlfc::tb {

/// A host and the memory that it must have: every byte is compared after each run, those that must
/// not change as well. What is wrong becomes the finding, such as "destination: ..."; later checks
/// are left out.
class ViewBench {
 public:
  /// `area` is the stream's reference area, which memory has from the start; `oracle` must outlive
  /// the bench. Rings of `ring_size` descriptors, a power of two.
  ViewBench(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream,
            std::span<const uint8_t> area, Oracle& oracle, unsigned ring_size = 4);

  ViewHost& host() { return host_; }

  /// Lets the driver fill the reference area, which must become the same again.
  void fill_area();

  /// Gives descriptors to the unit, waits until all are done, and compares.
  void run(std::span<const Descriptor> descriptors);

  /// The same with DRAIN, after which the queue must have stopped.
  void run_drained(std::span<const Descriptor> descriptors);

  /// Aborts `descriptor` after `clocks`, and goes on with `next`, which must be as if nothing had
  /// been; every other time by DRAIN.
  void run_aborted(const Descriptor& descriptor, uint64_t clocks, const Descriptor& next);

  /// Resets the unit while it decodes `descriptor`: by its pin if `hard`, else by the driver.
  void run_reset(const Descriptor& descriptor, uint64_t clocks, bool hard);

  /// The memory answers nothing from `clocks` of `descriptor` on: the watchdog must see it.
  void run_hung(const Descriptor& descriptor, uint64_t clocks);

  /// Gives descriptors before a LOAD, aborts, and goes on after the LOAD.
  void run_before_load(std::span<const Descriptor> descriptors);

  /// Lets both read masters read at once; clears DONE again and again, but `irq` must have risen.
  void run_during_load(std::span<const Descriptor> descriptors);
  void run_cleared(const Descriptor& descriptor);

  /// Lets all writes to, and all reads of, [begin, end) fail while `descriptor` runs; the status
  /// must be kBus.
  void run_with_fault(const Descriptor& descriptor, const FaultyRange& fault);

  /// The first that was wrong; empty for nothing.
  const std::string& finding() const { return host_.finding(); }

  /// Descriptors with result kAborted so far.
  uint64_t aborted() const { return aborted_; }

  /// The status of the descriptor that was done last, as the driver took it.
  const ViewStatus& last_status() const { return last_status_; }

 private:
  void expect_register(uint32_t address, uint32_t mask, uint32_t value, const char* what);
  void give(std::span<const Descriptor> descriptors);
  void take();
  void expect(const Descriptor& descriptor, uint16_t place);
  void expect_stopped(const Descriptor& descriptor, uint16_t place);
  void compare();
  void wait_and_compare(std::span<const Descriptor> descriptors);
  ViewStatus status_at(uint16_t place) const;
  uint64_t status_address(uint16_t place) const;
  unsigned block_size() const { return host_.parameters().block_size(); }

  ViewHost host_;
  Oracle& oracle_;
  std::vector<uint8_t> area_;
  SparseBytes expected_;
  ViewStatus last_status_;
  uint64_t aborted_ = 0;
};

}  // namespace hmlfc::tb
