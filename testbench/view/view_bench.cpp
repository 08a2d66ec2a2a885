#include "view/view_bench.hpp"

#include <algorithm>
#include <cstring>

#include "driver/hmlfc_registers.h"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kWatchdog = 1000;       // clocks; latencies here are shorter
constexpr uint64_t kAbortPatience = 8000;  // clocks; what is in flight takes fewer than 2000 here

}  // namespace

ViewBench::ViewBench(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream,
                     std::span<const uint8_t> area, Oracle& oracle, unsigned ring_size)
    : host_(std::move(unit), stream, ring_size), oracle_(oracle), area_(area.begin(), area.end()) {
  if (host_.area().size() != area_.size()) host_.find("area: its size");
  std::ranges::copy(std::span(area_).first(std::min(area_.size(), host_.area().size())),
                    host_.area().begin());
  host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_DISABLE_MASK);
  const auto high = static_cast<uint32_t>(host_.ring_base() >> 32);
  host_.write(HMLFC_REG_RING_BASE_HIGH, high | 1u << 18);  // bit 50 is not there
  expect_register(HMLFC_REG_RING_BASE_HIGH, ~0u, high, "RING_BASE");
  expect_register(HMLFC_REG_RING_SIZE, ~0u, ring_size, "RING_SIZE");
}

void ViewBench::expect_register(uint32_t address, uint32_t mask, uint32_t value, const char* what) {
  const uint32_t actual = host_.read(address) & mask;
  if (actual == value) return;
  host_.find(std::string("registers: ") + what + ": expected " + std::to_string(value) +
             ", actual " + std::to_string(actual));
}

void ViewBench::fill_area() {
  hmlfc_unit_resume(host_.driver());
  host_.fill_area();
  const auto [actual, expected] = std::ranges::mismatch(host_.area(), area_);
  if (actual == host_.area().end()) return;
  host_.find("area: byte " + std::to_string(actual - host_.area().begin()) + ": expected " +
             std::to_string(*expected) + ", actual " + std::to_string(*actual));
}

void ViewBench::give(std::span<const Descriptor> descriptors) {
  host_.take_events();
  host_.write(HMLFC_REG_INTERRUPT_STATUS, ~0u);
  expected_ = host_.memory().content;
  for (const Descriptor& d : descriptors) {
    const unsigned place = host_.driver()->producer % host_.ring_size();
    const auto words = d.words();
    std::memcpy(expected_.at(host_.ring_base() + place * kDescriptorBytes).data(), words.data(),
                kDescriptorBytes);
    host_.give(d);
  }
}

uint64_t ViewBench::status_address(uint16_t place) const {
  return host_.status_base() + uint64_t{place % host_.ring_size()} * kViewStatusBytes;
}

ViewStatus ViewBench::status_at(uint16_t place) const {
  std::array<uint32_t, 4> words{};
  std::memcpy(words.data(), host_.memory().content.at(status_address(place)).data(),
              kViewStatusBytes);
  return ViewStatus::of_words(words);
}

void ViewBench::take() {
  const uint16_t place = host_.driver()->taken;
  const hmlfc_status s = host_.wait();
  last_status_ = {s.tag, static_cast<ViewResult>(s.result), s.first_error, s.blocks, s.writes};
  if (last_status_ != status_at(place)) host_.find("driver: status");
}

void ViewBench::expect(const Descriptor& descriptor, uint16_t place) {
  const ViewStatus status = write_expected(oracle_, descriptor, block_size(), expected_);
  std::memcpy(expected_.at(status_address(place)).data(), status.words().data(), kViewStatusBytes);
}

void ViewBench::compare() {
  if (!finding().empty()) return;
  const std::vector<uint8_t>& memory = host_.memory().content.bytes;
  const auto [actual, expected] = std::ranges::mismatch(memory, expected_.bytes);
  if (actual == memory.end()) return;
  const auto index = static_cast<uint64_t>(actual - memory.begin());
  const uint64_t statuses = uint64_t{host_.ring_size()} * kDescriptorBytes;
  const bool status = index >= statuses && index < HMLFC_RINGS_BYTES(host_.ring_size());
  host_.find((status                        ? "status: "
              : index >= host_.free_bytes() ? "destination: "
                                            : "outside: ") +
             std::string("byte ") + std::to_string(index) + ": expected " +
             std::to_string(*expected) + ", actual " + std::to_string(*actual));
}

void ViewBench::wait_and_compare(std::span<const Descriptor> descriptors) {
  const uint16_t first = host_.driver()->taken;
  for (size_t i = 0; i < descriptors.size() && finding().empty(); ++i) take();
  if (!finding().empty()) return;
  uint16_t place = first;
  for (const Descriptor& descriptor : descriptors) expect(descriptor, place++);
  compare();
}

void ViewBench::run(std::span<const Descriptor> descriptors) {
  hmlfc_unit_resume(host_.driver());
  // The last event of all, which must come without a clock for anything else.
  hmlfc_unit_enable_events(host_.driver(), HMLFC_REG_INTERRUPT_ENABLE_EMPTY_MASK);
  give(descriptors);
  host_.idle_until_interrupt();
  hmlfc_unit_enable_events(host_.driver(), HMLFC_REG_INTERRUPT_ENABLE_MASK);
  wait_and_compare(descriptors);
  const uint32_t events = host_.take_events() | host_.read(HMLFC_REG_INTERRUPT_STATUS);
  if ((events & HMLFC_REG_INTERRUPT_STATUS_DONE_MASK) == 0)
    host_.find("registers: the interrupt DONE is missing");
  host_.write(HMLFC_REG_INTERRUPT_STATUS, HMLFC_REG_INTERRUPT_STATUS_MASK);
  expect_register(HMLFC_REG_INTERRUPT_STATUS, HMLFC_REG_INTERRUPT_STATUS_MASK, 0,
                  "INTERRUPT_STATUS, cleared");
  expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_MASK,
                  HMLFC_REG_VIEW_STATUS_ENABLED_MASK | HMLFC_REG_VIEW_STATUS_EMPTY_MASK, "STATUS");
}

void ViewBench::run_drained(std::span<const Descriptor> descriptors) {
  host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_DISABLE_MASK);
  give(descriptors);
  host_.write(HMLFC_REG_VIEW_CONTROL,
              HMLFC_REG_VIEW_CONTROL_ENABLE_MASK | HMLFC_REG_VIEW_CONTROL_DRAIN_MASK);
  if (hmlfc_unit_drain(host_.driver()) != HMLFC_OK) return host_.find("hang: DRAIN");
  wait_and_compare(descriptors);
  expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_MASK,
                  HMLFC_REG_VIEW_STATUS_EMPTY_MASK, "STATUS after DRAIN");
  const uint32_t events = host_.take_events() | host_.read(HMLFC_REG_INTERRUPT_STATUS);
  if ((events & HMLFC_REG_INTERRUPT_STATUS_STOPPED_MASK) == 0)
    host_.find("registers: the interrupt STOPPED is missing");
}

// What an aborted descriptor has written is right, and the rest is as it was; the bitmap may lack
// errors of blocks that were not decoded.
void ViewBench::expect_stopped(const Descriptor& descriptor, uint16_t place) {
  const ViewStatus status = status_at(place);
  if (status.result != ViewResult::kAborted) return expect(descriptor, place);
  ++aborted_;
  if (status.tag != descriptor.tag) host_.find("status: of an aborted descriptor");
  const std::vector<uint8_t>& memory = host_.memory().content.bytes;
  const std::vector<uint8_t> old = expected_.bytes;
  expect(descriptor, place);
  std::memcpy(expected_.at(status_address(place)).data(), status.words().data(), kViewStatusBytes);
  for (size_t i = 0; i < memory.size(); ++i) {
    if (memory[i] == old[i]) expected_.bytes[i] = old[i];
  }
  if (descriptor.bitmap == 0) return;
  const std::span<const uint8_t> bitmap =
      std::as_const(host_.memory().content).at(descriptor.bitmap);
  for (uint64_t i = 0; i < bitmap_bytes(descriptor, block_size()); ++i) {
    expected_.at(descriptor.bitmap)[i] &= bitmap[i];
  }
}

void ViewBench::run_aborted(const Descriptor& descriptor, uint64_t clocks, const Descriptor& next) {
  const uint16_t first = host_.driver()->producer;
  const Descriptor both[]{descriptor, next};
  hmlfc_unit_resume(host_.driver());
  give(both);
  host_.idle(clocks);
  const uint64_t begin = host_.clocks();
  if (hmlfc_unit_abort(host_.driver()) != HMLFC_OK) return host_.find("hang: ABORT");
  if (host_.clocks() - begin > kAbortPatience) host_.find("hang: ABORT asks for more blocks");
  // The unit may have ended the first already, or even both.
  const auto done = static_cast<uint16_t>(host_.read(HMLFC_REG_CONSUMER) - first);
  if (done > 2) return host_.find("registers: CONSUMER after ABORT");
  for (uint16_t i = 0; i < done; ++i) {
    take();
    expect_stopped(both[i], static_cast<uint16_t>(first + i));
  }
  compare();
  expected_ = host_.memory().content;
  if (clocks % 2 == 0) {
    // Nothing is under way: there is nothing to wait for.
    host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_DRAIN_MASK);
    expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_MASK,
                    done == 2 ? HMLFC_REG_VIEW_STATUS_EMPTY_MASK : 0, "STATUS after ABORT, DRAIN");
    if (hmlfc_unit_drain(host_.driver()) != HMLFC_OK) host_.find("hang: DRAIN after ABORT");
  }
  hmlfc_unit_resume(host_.driver());
  wait_and_compare(std::span(both).subspan(done));
}

void ViewBench::run_reset(const Descriptor& descriptor, uint64_t clocks, bool hard) {
  hmlfc_unit_resume(host_.driver());
  give(std::span(&descriptor, 1));
  host_.idle(clocks);
  host_.open(hard);
  host_.load();
}

void ViewBench::run_hung(const Descriptor& descriptor, uint64_t clocks) {
  hmlfc_unit_set_watchdog(host_.driver(), kWatchdog);
  give(std::span(&descriptor, 1));
  host_.idle(clocks);
  host_.memory().set_mute(true);
  const uint64_t begin = host_.clocks();
  hmlfc_status status;
  if (hmlfc_unit_wait(host_.driver(), &status) == HMLFC_TIMEOUT) {
    if (host_.clocks() - begin > kAbortPatience) host_.find("hang: the watchdog");
    if ((host_.take_events() & HMLFC_REG_INTERRUPT_STATUS_HANG_MASK) == 0)
      host_.find("registers: the interrupt HANG is missing");
    host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_RESET_MASK);
    host_.idle(kWatchdog);
    expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_RESETTING_MASK,
                    HMLFC_REG_VIEW_STATUS_RESETTING_MASK, "RESETTING before the last answer");
  } else if (clocks == 0) {
    host_.find("status: of a descriptor that cannot have been read");
  }
  host_.memory().set_mute(false);
  host_.open(false);
  host_.load();
}

void ViewBench::run_before_load(std::span<const Descriptor> descriptors) {
  host_.open(false);
  give(descriptors);
  host_.idle(kWatchdog);
  const uint64_t begin = host_.clocks();
  if (hmlfc_unit_abort(host_.driver()) != HMLFC_OK || host_.clocks() - begin > kAbortPatience)
    return host_.find("hang: ABORT before LOAD");
  expect_register(HMLFC_REG_CONSUMER, ~0u, 0, "CONSUMER before LOAD");
  host_.load();
  hmlfc_unit_resume(host_.driver());
  wait_and_compare(descriptors);
}

void ViewBench::run_during_load(std::span<const Descriptor> descriptors) {
  host_.memory().start({.latency = 5, .address_stall = 930}, descriptors.front().tag);
  host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_DISABLE_MASK);
  give(descriptors);
  host_.write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  host_.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  wait_and_compare(descriptors);
}

void ViewBench::run_cleared(const Descriptor& descriptor) {
  hmlfc_unit_resume(host_.driver());
  hmlfc_unit_enable_events(host_.driver(), HMLFC_REG_INTERRUPT_ENABLE_DONE_MASK);
  give(std::span(&descriptor, 1));
  const uint64_t before = host_.interrupt_clocks();
  const uint16_t next = host_.driver()->producer;
  do {
    for (int i = 0; i < 4; ++i)
      host_.write(HMLFC_REG_INTERRUPT_STATUS, HMLFC_REG_INTERRUPT_STATUS_DONE_MASK);
  } while (host_.read(HMLFC_REG_CONSUMER) != next && finding().empty());
  if (host_.interrupt_clocks() == before) host_.find("registers: an interrupt was lost");
  hmlfc_unit_enable_events(host_.driver(), HMLFC_REG_INTERRUPT_ENABLE_MASK);
  wait_and_compare(std::span(&descriptor, 1));
}

void ViewBench::run_with_fault(const Descriptor& descriptor, const FaultyRange& fault) {
  AxiMemory& memory = host_.memory();
  const uint64_t failed = memory.failed_writes;
  hmlfc_unit_resume(host_.driver());
  memory.set_faults({fault});
  give(std::span(&descriptor, 1));
  const uint16_t place = host_.driver()->taken;
  take();
  memory.set_faults({});
  ViewStatus status;  // of a descriptor that could not be read
  const auto write_errors = static_cast<uint32_t>(memory.failed_writes - failed);
  if (write_errors != 0) status = write_expected(oracle_, descriptor, block_size(), expected_);
  status.result = ViewResult::kBus;
  status.write_errors = write_errors;
  std::memcpy(expected_.at(status_address(place)).data(), status.words().data(), kViewStatusBytes);
  compare();
  const uint32_t events = host_.take_events() | host_.read(HMLFC_REG_INTERRUPT_STATUS);
  if ((events & HMLFC_REG_INTERRUPT_STATUS_ERROR_MASK) == 0)
    host_.find("registers: the interrupt ERROR is missing");
}

}  // namespace hmlfc::tb
