// The view unit with a memory and its C driver; no golden model.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "driver/hmlfc_driver.h"
#include "unit/host.hpp"
#include "view/descriptor.hpp"

namespace hmlfc::tb {

/// One unit and one stream. The rings, the stream, its reference area, and each destination and
/// bitmap with random bytes lie at places of their own, which the stream's bytes and the state of
/// the unit draw over the whole width of addresses.
class ViewHost final : public Host {
 public:
  /// Rings of `ring_size` descriptors, a power of two. A stream that the driver refuses has an
  /// empty area and is not loaded.
  ViewHost(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream, unsigned ring_size);

  /// What the driver says of the stream.
  const hmlfc_error& stream_error() const { return stream_error_; }
  const hmlfc_stream& stream() const { return stream_; }

  /// The driver takes the unit, after a reset of unit and memory channels if `hard`.
  void open(bool hard);

  /// The driver loads the stream.
  void load();

  /// Lets the driver fill the reference area: key images by OpenJPEG, residuals by the unit.
  void fill_area();

  /// A place for the descriptor's pixels (with `gap` bytes more a row, a multiple
  /// of 16), or strips, and its bitmap, if `bitmap`; strips have none.
  void allocate(Descriptor& descriptor, uint32_t gap, bool bitmap);

  /// Forgets all such places.
  void free_all();

  /// Writes a descriptor into the ring; the unit sees it.
  void give(const Descriptor& descriptor);

  /// Lets clocks pass, without any access, until `irq` is high.
  void idle_until_interrupt();

  /// Waits until the descriptor that was given first is done.
  hmlfc_status wait();

  /// Decodes one descriptor.
  hmlfc_status run(const Descriptor& descriptor);

  /// The driver, with the memory where it is now.
  hmlfc_unit* driver();

  /// Events since the last call, which the driver's callback has cleared.
  uint32_t take_events();

  unsigned ring_size() const { return ring_size_; }
  std::span<uint8_t> area();
  uint64_t ring_base() const { return driver_.rings.bus; }
  uint64_t status_base() const { return ring_base() + uint64_t{ring_size_} * kDescriptorBytes; }
  /// Where the places that can be forgotten begin in the bytes of the memory, after the rings.
  uint64_t free_bytes() const { return free_bytes_; }

 private:
  hmlfc_buffer buffer(uint64_t address, uint64_t bytes);
  int wait_for_interrupt();
  void check(int code, const char* what);

  unsigned ring_size_;
  hmlfc_stream stream_{};
  hmlfc_error stream_error_{};
  hmlfc_unit driver_{};
  uint64_t ring_base_ = 0, stream_base_ = 0, area_base_ = 0;
  size_t places_ = 0;        // of these
  uint64_t free_bytes_ = 0;  // index of the first byte after these
  uint64_t deadline_ = 0;
  uint32_t events_ = 0;
};

}  // namespace hmlfc::tb
