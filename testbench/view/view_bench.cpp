#include "view/view_bench.hpp"

#include <algorithm>
#include <cstring>

#include "arithmetic/rounding.hpp"
#include "oracle/reference_area.hpp"
#include "unit/registers.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kStreamBase = 0x1000;
constexpr uint64_t kAlignment = 4096;
constexpr uint64_t kPatience = 400'000;  // clocks without the end of a descriptor
constexpr uint64_t kAccessPatience = 10'000;
constexpr uint64_t kSlack = 64;  // between two places, which nothing may write

uint64_t aligned(uint64_t address) { return ceil_div(address, kAlignment) * kAlignment; }

}  // namespace

ViewBench::ViewBench(std::unique_ptr<ViewUnit> unit, std::span<const uint8_t> stream,
                     std::span<const uint8_t> area, Oracle& oracle, unsigned ring_size)
    : unit_(std::move(unit)),
      oracle_(oracle),
      ring_size_(ring_size),
      stream_bytes_(stream.size()),
      area_base_(aligned(kStreamBase + stream.size() + 32)),
      ring_base_(aligned(area_base_ + area.size() + 32) + kDescriptorBytes),
      status_base_(ring_base_ + uint64_t{ring_size} * kDescriptorBytes + 48),
      free_base_(aligned(status_base_ + uint64_t{ring_size} * kViewStatusBytes)),
      free_(free_base_) {
  memory_.bytes.resize(free_base_);
  std::ranges::copy(stream, memory_.bytes.begin() + kStreamBase);
  std::ranges::copy(area, memory_.bytes.begin() + static_cast<ptrdiff_t>(area_base_));
  set_conditions({}, 0);
  reset();
}

void ViewBench::find(const std::string& what) {
  if (!finding_.empty()) return;
  finding_ = what + " (HMLFC_RTL_STATE=" + std::to_string(unit_->state_seed()) + ")";
}

void ViewBench::set_conditions(const Conditions& conditions, uint64_t seed) {
  memory_.start(conditions, seed, unit_->parameters().beat_bytes);
}

// A rising edge: the unit samples its inputs, then next_ becomes its inputs.
void ViewBench::clock() {
  memory_.edge(in_, out_, next_);
  unit_->clock(next_, out_);
  in_ = next_;
  ++clocks_;
  if (!memory_.finding.empty()) find(memory_.finding);
}

void ViewBench::idle(uint64_t clocks) {
  while (clocks-- > 0) clock();
}

void ViewBench::write(uint32_t address, uint32_t value) {
  next_.aw_valid = next_.w_valid = next_.b_ready = true;
  next_.aw_addr = address;
  next_.w_data = value;
  next_.w_strb = 15;
  for (uint64_t clocks = 0; next_.aw_valid || next_.w_valid || next_.b_ready; ++clocks) {
    if (clocks == kAccessPatience) return find("hang: a register write");
    clock();
    // What is shown and taken now passes at the next edge.
    if (in_.aw_valid && out_.aw_ready) next_.aw_valid = false;
    if (in_.w_valid && out_.w_ready) next_.w_valid = false;
    if (in_.b_ready && out_.b_valid) next_.b_ready = false;
  }
  clock();
}

uint32_t ViewBench::read(uint32_t address) {
  next_.lite_ar_valid = next_.lite_r_ready = true;
  next_.lite_ar_addr = address;
  uint32_t value = 0;
  for (uint64_t clocks = 0; next_.lite_ar_valid || next_.lite_r_ready; ++clocks) {
    if (clocks == kAccessPatience) {
      find("hang: a register read");
      return 0;
    }
    clock();
    if (in_.lite_ar_valid && out_.lite_ar_ready) next_.lite_ar_valid = false;
    if (in_.lite_r_ready && out_.lite_r_valid) {
      value = out_.lite_r_data;
      next_.lite_r_ready = false;
    }
  }
  clock();
  return value;
}

void ViewBench::write_pair(uint32_t address, uint64_t value) {
  write(address, static_cast<uint32_t>(value));
  write(address + 4, static_cast<uint32_t>(value >> 32));
}

void ViewBench::expect_register(uint32_t address, uint32_t mask, uint32_t value, const char* what) {
  const uint32_t actual = read(address) & mask;
  if (actual == value) return;
  find(std::string("registers: ") + what + ": expected " + std::to_string(value) + ", actual " +
       std::to_string(actual));
}

void ViewBench::reset() {
  next_ = {};
  for (int i = 0; i < 4; ++i) clock();
  next_.rst_n = true;
  clock();
  producer_ = 0;
  expect_register(HMLFC_REG_VIEW_ID, ~0u, HMLFC_REG_VIEW_ID_RESET, "ID");
  write_pair(HMLFC_REG_RING_BASE, ring_base_ | uint64_t{1} << 50);  // bit 50 is not there
  write_pair(HMLFC_REG_STATUS_BASE, status_base_);
  write(HMLFC_REG_RING_SIZE, ring_size_);
  expect_register(HMLFC_REG_RING_BASE_HIGH, ~0u, static_cast<uint32_t>(ring_base_ >> 32),
                  "RING_BASE");
  expect_register(HMLFC_REG_RING_SIZE, ~0u, ring_size_, "RING_SIZE");
  write(HMLFC_REG_INTERRUPT_ENABLE, HMLFC_REG_INTERRUPT_ENABLE_EMPTY_MASK);
  if (!unit_->reads_stream()) return;
  expect_register(HMLFC_REG_ID, ~0u, HMLFC_REG_ID_RESET, "ID of the decode unit");
  reg::write_stream([&](uint32_t at, uint32_t word) { write(at, word); }, kStreamBase,
                    stream_bytes_, area_base_);
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  while (finding_.empty() && (read(HMLFC_REG_STATUS) & HMLFC_REG_STATUS_LOADING_MASK) != 0)
    continue;
}

void ViewBench::allocate(Descriptor& d, uint32_t gap, bool bitmap) {
  const unsigned b = unit_->parameters().block_size();
  const bool strips = is_residuals(d.format);
  const uint32_t rows = strips ? ceil_div(d.height, b) : d.height;
  d.pitch = gap + (strips ? strips_in_row(d.width, b) * kStripBytes
                          : ceil_div(d.width * bytes_of(d.format), 16u) * 16);
  d.destination = free_ + kSlack;
  free_ = ceil_div(d.destination + uint64_t{d.pitch} * rows + kSlack, uint64_t{16}) * 16;
  if (bitmap && !strips) {
    d.bitmap = free_ + 8;
    free_ = ceil_div(d.bitmap + bitmap_bytes(d, b) + kSlack, uint64_t{16}) * 16;
  }
  Random random(free_);
  while (memory_.bytes.size() < free_) memory_.bytes.push_back(static_cast<uint8_t>(random.next()));
}

void ViewBench::free_all() {
  free_ = free_base_;
  memory_.bytes.resize(free_base_);
}

void ViewBench::give(std::span<const Descriptor> descriptors) {
  for (const Descriptor& d : descriptors) {
    const auto words = d.words();
    std::memcpy(memory_.bytes.data() + ring_base_ + producer_ % ring_size_ * kDescriptorBytes,
                words.data(), kDescriptorBytes);
    ++producer_;
  }
  expected_ = memory_.bytes;
  write(HMLFC_REG_INTERRUPT_STATUS, ~0u);
  write(HMLFC_REG_PRODUCER, producer_);
}

void ViewBench::wait(uint16_t consumer) {
  for (uint64_t clocks = 0; finding_.empty(); ++clocks) {
    if (clocks >= kPatience + 50 * expected_.size()) return find("hang: a descriptor");
    for (int i = 0; i < 16; ++i) clock();
    if (!out_.interrupt) continue;
    expect_register(HMLFC_REG_CONSUMER, ~0u, consumer, "CONSUMER");
    const uint32_t events = read(HMLFC_REG_INTERRUPT_STATUS);
    if ((events & HMLFC_REG_INTERRUPT_STATUS_DONE_MASK) == 0)
      find("registers: the interrupt DONE is missing");
    return;
  }
}

uint64_t ViewBench::status_address(uint16_t place) const {
  return status_base_ + uint64_t{place % ring_size_} * kViewStatusBytes;
}

ViewStatus ViewBench::status_at(uint16_t place) const {
  std::array<uint32_t, 4> words{};
  std::memcpy(words.data(), memory_.bytes.data() + status_address(place), kViewStatusBytes);
  return ViewStatus::of_words(words);
}

ViewStatus ViewBench::last_status() const {
  return status_at(static_cast<uint16_t>(producer_ - 1));
}

void ViewBench::expect(const Descriptor& descriptor, uint16_t place) {
  const ViewStatus status =
      write_expected(oracle_, descriptor, unit_->parameters().block_size(), expected_);
  std::memcpy(expected_.data() + status_address(place), status.words().data(), kViewStatusBytes);
}

void ViewBench::compare() {
  const auto [actual, expected] = std::ranges::mismatch(memory_.bytes, expected_);
  if (actual == memory_.bytes.end()) return;
  const auto at = static_cast<uint64_t>(actual - memory_.bytes.begin());
  const bool status = at >= status_base_ && at < status_base_ + ring_size_ * kViewStatusBytes;
  find((status             ? "status: byte "
        : at >= free_base_ ? "destination: byte "
                           : "outside: byte ") +
       std::to_string(at) + ": expected " + std::to_string(*expected) + ", actual " +
       std::to_string(*actual));
}

void ViewBench::run(std::span<const Descriptor> descriptors) {
  const uint16_t first = producer_;
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  give(descriptors);
  wait(producer_);
  uint16_t place = first;
  for (const Descriptor& descriptor : descriptors) expect(descriptor, place++);
  if (finding_.empty()) compare();
  expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_MASK,
                  HMLFC_REG_VIEW_STATUS_ENABLED_MASK | HMLFC_REG_VIEW_STATUS_EMPTY_MASK, "STATUS");
}

void ViewBench::run_drained(std::span<const Descriptor> descriptors) {
  const uint16_t first = producer_;
  give(descriptors);
  write(HMLFC_REG_VIEW_CONTROL,
        HMLFC_REG_VIEW_CONTROL_ENABLE_MASK | HMLFC_REG_VIEW_CONTROL_DRAIN_MASK);
  wait(producer_);
  uint16_t place = first;
  for (const Descriptor& descriptor : descriptors) expect(descriptor, place++);
  if (finding_.empty()) compare();
  for (int i = 0; i < 4; ++i) clock();
  expect_register(HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_MASK,
                  HMLFC_REG_VIEW_STATUS_EMPTY_MASK, "STATUS after DRAIN");
  expect_register(HMLFC_REG_INTERRUPT_STATUS, HMLFC_REG_INTERRUPT_STATUS_STOPPED_MASK,
                  HMLFC_REG_INTERRUPT_STATUS_STOPPED_MASK, "STOPPED");
}

// What an aborted descriptor has written is right, and the rest is as it was; the bitmap may lack
// errors of blocks that were not decoded.
void ViewBench::expect_stopped(const Descriptor& descriptor, uint16_t place) {
  const ViewStatus status = status_at(place);
  if (status.result != ViewResult::kAborted) return expect(descriptor, place);
  ++aborted_;
  if (status.tag != descriptor.tag) find("status: of an aborted descriptor");
  const std::vector<uint8_t> old = expected_;
  expect(descriptor, place);
  std::memcpy(expected_.data() + status_address(place), status.words().data(), kViewStatusBytes);
  for (size_t i = 0; i < expected_.size(); ++i) {
    if (memory_.bytes[i] == old[i]) expected_[i] = old[i];
  }
  if (descriptor.bitmap == 0) return;
  const uint64_t bytes = bitmap_bytes(descriptor, unit_->parameters().block_size());
  for (uint64_t i = descriptor.bitmap; i < descriptor.bitmap + bytes; ++i) {
    expected_[i] &= memory_.bytes[i];
  }
}

void ViewBench::run_aborted(const Descriptor& descriptor, uint64_t clocks, const Descriptor& next) {
  const uint16_t first = producer_;
  const Descriptor both[]{descriptor, next};
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  give(both);
  for (uint64_t i = 0; i < clocks; ++i) clock();
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ABORT_MASK);
  for (uint64_t i = 0; (read(HMLFC_REG_VIEW_STATUS) & HMLFC_REG_VIEW_STATUS_ENABLED_MASK) != 0;
       ++i) {
    if (i == kAccessPatience) return find("hang: ABORT");
  }
  // The unit may have ended the first already, or even both.
  const auto done = static_cast<uint16_t>(read(HMLFC_REG_CONSUMER) - first);
  if (done > 2) return find("registers: CONSUMER after ABORT");
  for (uint16_t i = 0; i < done; ++i) expect_stopped(both[i], static_cast<uint16_t>(first + i));
  if (finding_.empty()) compare();
  expected_ = memory_.bytes;
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  if (done < 2) wait(producer_);
  for (uint16_t i = done; i < 2; ++i) expect(both[i], static_cast<uint16_t>(first + i));
  if (finding_.empty()) compare();
}

void ViewBench::run_reset(const Descriptor& descriptor, uint64_t clocks) {
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  give(std::span(&descriptor, 1));
  for (uint64_t i = 0; i < clocks; ++i) clock();
  reset();
}

void ViewBench::run_with_fault(const Descriptor& descriptor, ViewMemory::Fault fault) {
  const uint16_t place = producer_;
  const uint64_t failed = memory_.failed_writes;
  write(HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
  memory_.fault = fault;
  give(std::span(&descriptor, 1));
  wait(producer_);
  memory_.fault.reset();
  ViewStatus status;  // of a descriptor that could not be read
  const auto write_errors = static_cast<uint32_t>(memory_.failed_writes - failed);
  if (write_errors != 0) {
    status = write_expected(oracle_, descriptor, unit_->parameters().block_size(), expected_);
  }
  status.result = ViewResult::kBus;
  status.write_errors = write_errors;
  std::memcpy(expected_.data() + status_address(place), status.words().data(), kViewStatusBytes);
  if (finding_.empty()) compare();
  expect_register(HMLFC_REG_INTERRUPT_STATUS, HMLFC_REG_INTERRUPT_STATUS_ERROR_MASK,
                  HMLFC_REG_INTERRUPT_STATUS_ERROR_MASK, "ERROR");
}

}  // namespace hmlfc::tb
