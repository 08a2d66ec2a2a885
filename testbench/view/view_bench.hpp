// The view unit with a memory and software's side of its registers; no SystemC.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "view/expected_view.hpp"
#include "view/view_memory.hpp"

namespace hmlfc::tb {

/// One unit and one stream. Memory holds the stream, its reference area, the rings, and behind them
/// a free part that starts with random bytes: destinations and bitmaps are allocated there.
///
/// Every byte of the memory is compared after each run, those that must not change as well. What is
/// wrong becomes the finding, such as "destination: ..."; later checks are left out.
class ViewBench {
 public:
  /// Rings of `ring_size` descriptors, a power of two. `oracle` must outlive the bench.
  ViewBench(std::unique_ptr<ViewUnit> unit, std::span<const uint8_t> stream,
            std::span<const uint8_t> area, Oracle& oracle, unsigned ring_size = 4);

  void set_conditions(const Conditions& conditions, uint64_t seed);

  /// Resets unit and memory channels; then registers are written, and the stream is LOADed.
  void reset();

  /// A place of the free part for the descriptor's pixels (with `gap` bytes more a row, a multiple
  /// of 16), or strips, and its bitmap, if `bitmap`; strips have none.
  void allocate(Descriptor& descriptor, uint32_t gap, bool bitmap);

  /// Forgets all places: the free part is random again.
  void free_all();

  /// Gives descriptors to the unit, waits until all are done, and compares.
  void run(std::span<const Descriptor> descriptors);

  /// The same with DRAIN, after which the queue must have stopped.
  void run_drained(std::span<const Descriptor> descriptors);

  /// Aborts `descriptor` after `clocks`, and goes on with `next`, which must be as if nothing had
  /// been.
  void run_aborted(const Descriptor& descriptor, uint64_t clocks, const Descriptor& next);

  /// Resets the unit while it decodes `descriptor`.
  void run_reset(const Descriptor& descriptor, uint64_t clocks);

  /// Lets all writes to, and all reads of, [begin, end) fail while `descriptor` runs; the status
  /// must be kBus.
  void run_with_fault(const Descriptor& descriptor, ViewMemory::Fault fault);

  /// Lets `clocks` pass.
  void idle(uint64_t clocks);

  /// Of the unit: ViewUnit::stopped_clocks().
  uint64_t stopped_clocks() const { return unit_->stopped_clocks(); }

  /// The first thing that was wrong; empty for nothing.
  const std::string& finding() const { return finding_; }

  /// Descriptors with result kAborted so far.
  uint64_t aborted() const { return aborted_; }

  const ViewMemory& memory() const { return memory_; }
  uint64_t clocks() const { return clocks_; }
  uint64_t ring_base() const { return ring_base_; }

  /// The status of the descriptor that was done last, as it stands in memory.
  ViewStatus last_status() const;

 private:
  void find(const std::string& what);
  void clock();
  void write(uint32_t address, uint32_t value);
  uint32_t read(uint32_t address);
  void write_pair(uint32_t address, uint64_t value);
  void expect_register(uint32_t address, uint32_t mask, uint32_t value, const char* what);
  void give(std::span<const Descriptor> descriptors);
  void wait(uint16_t consumer);
  void expect(const Descriptor& descriptor, uint16_t place);
  void expect_stopped(const Descriptor& descriptor, uint16_t place);
  void compare();
  ViewStatus status_at(uint16_t place) const;
  uint64_t status_address(uint16_t place) const;

  std::unique_ptr<ViewUnit> unit_;
  Oracle& oracle_;
  unsigned ring_size_;
  uint64_t stream_bytes_;
  uint64_t area_base_, ring_base_, status_base_, free_base_, free_;
  ViewMemory memory_;
  std::vector<uint8_t> expected_;
  ViewInputs in_, next_;
  ViewOutputs out_;
  std::string finding_;
  uint64_t clocks_ = 0;
  uint16_t producer_ = 0;
  uint64_t aborted_ = 0;
};

}  // namespace hmlfc::tb
