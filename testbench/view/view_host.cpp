#include "view/view_host.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "bits/crc32c.hpp"
#include "driver/hmlfc_openjpeg.h"
#include "driver/hmlfc_registers.h"
#include "view/expected_view.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kRingAlignment = 64;
constexpr uint64_t kBitmapAlignment = 8;
constexpr uint64_t kPatience = 400'000;  // clocks without the end of a descriptor
constexpr uint64_t kPatienceOfByte = 50;
constexpr uint64_t kTurn = 1024;  // clocks of one wait without an interrupt

ViewHost& host_of(void* context) { return *static_cast<ViewHost*>(context); }

}  // namespace

ViewHost::ViewHost(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream, unsigned ring_size)
    : Host(std::move(unit), crc32c(stream)), ring_size_(ring_size) {
  ring_base_ = take_place(HMLFC_RINGS_BYTES(ring_size), kRingAlignment, 0);
  memory().start({}, 0);
  open(true);
  hmlfc_stream_open(&stream_, stream.data(), stream.size(), &driver_.limits, &stream_error_);
  if (stream_error_.code != HMLFC_OK) stream_.area_bytes = 0;
  stream_base_ = take_stream_place(stream.size());
  std::ranges::copy(stream, memory().content.at(stream_base_).begin());
  area_base_ = take_place(stream_.area_bytes, HMLFC_STRIP_BYTES, 0);
  places_ = space_.size();
  free_bytes_ = memory().content.bytes.size();
  load();
}

void ViewHost::check(int code, const char* what) {
  if (code != HMLFC_OK) find(std::string("driver: ") + what + ": " + std::to_string(code));
}

hmlfc_buffer ViewHost::buffer(uint64_t address, uint64_t bytes) {
  return {memory().content.at(address).data(), address, bytes};
}

std::span<uint8_t> ViewHost::area() {
  return memory().content.at(area_base_).first(stream_.area_bytes);
}

// What a driver's thread and its interrupt handler do.
int ViewHost::wait_for_interrupt() {
  for (uint64_t i = 0; i < kTurn && !out_.interrupt; ++i) clock();
  if (out_.interrupt) events_ |= hmlfc_unit_events(&driver_);
  return clocks() > deadline_ || !finding().empty() ? 1 : 0;
}

void ViewHost::idle_until_interrupt() {
  driver();  // the deadline
  while (!out_.interrupt && finding().empty()) {
    clock();
    if (clocks() > deadline_) find("hang: no interrupt");
  }
}

// Also of an interrupt that came while the driver read a register.
uint32_t ViewHost::take_events() {
  if (out_.interrupt) events_ |= hmlfc_unit_events(&driver_);
  return std::exchange(events_, 0);
}

hmlfc_unit* ViewHost::driver() {
  driver_.rings = buffer(ring_base_, HMLFC_RINGS_BYTES(ring_size_));
  deadline_ = clocks() + kPatience + kPatienceOfByte * memory().content.bytes.size();
  return &driver_;
}

void ViewHost::open(bool hard) {
  if (hard) reset_unit();
  const hmlfc_io io{
      this,
      [](void* host, uint32_t offset) { return host_of(host).read(offset); },
      [](void* host, uint32_t offset, uint32_t value) { host_of(host).write(offset, value); },
      [](void* host) { return host_of(host).wait_for_interrupt(); },
      nullptr,
      nullptr};
  const hmlfc_buffer rings = buffer(ring_base_, HMLFC_RINGS_BYTES(ring_size_));
  deadline_ = clocks() + kPatience;
  check(hmlfc_unit_open(&driver_, &io, &rings, ring_size_), "opens no unit");
  hmlfc_unit_enable_events(&driver_, HMLFC_REG_INTERRUPT_ENABLE_MASK);
}

void ViewHost::load() {
  if (stream_error_.code != HMLFC_OK) return;
  const hmlfc_buffer area = buffer(area_base_, stream_.area_bytes);
  check(hmlfc_unit_load(driver(), &stream_, stream_base_, &area), "LOAD");
}

void ViewHost::fill_area() {
  std::ranges::fill(area(), uint8_t{0});
  std::vector<int16_t> samples(size_t{stream_.width} * stream_.height);
  hmlfc_error error;
  const hmlfc_buffer buffer_of_area = buffer(area_base_, stream_.area_bytes);
  uint64_t failed = 0;
  check(hmlfc_fill_key_images(&stream_, &buffer_of_area, hmlfc_openjpeg_decode, nullptr,
                              samples.data(), samples.size(), &failed, &error),
        "key images");
  check(hmlfc_unit_fill_residuals(driver(), &stream_, &buffer_of_area, &failed), "residuals");
}

void ViewHost::allocate(Descriptor& d, uint32_t gap, bool bitmap) {
  const unsigned b = parameters().block_size();
  const bool strips = is_residuals(d.format);
  const uint32_t rows = strips ? ceil_div(d.height, b) : d.height;
  const uint32_t blocks_x = ceil_div(d.width, uint32_t{b});
  d.pitch = gap + (strips ? ceil_div(blocks_x, 64u / (b * b)) * HMLFC_STRIP_BYTES
                          : ceil_div(d.width * bytes_of(d.format), 16u) * 16);
  const uint64_t first = memory().content.bytes.size();
  d.destination = take_place(uint64_t{d.pitch} * rows, kAlignment, 0);
  if (bitmap && !strips) {
    // Not at address 0, which says that there is none.
    const uint64_t bytes = kBitmapAlignment + bitmap_bytes(d, b);
    d.bitmap = take_place(bytes, kBitmapAlignment, 0) + kBitmapAlignment;
  }
  Random random(d.destination);
  for (uint8_t& byte : std::span(memory().content.bytes).subspan(first)) {
    byte = static_cast<uint8_t>(random.next());
  }
}

void ViewHost::free_all() {
  space_.resize(places_);
  memory().content.cut(free_bytes_);
}

void ViewHost::give(const Descriptor& d) {
  const hmlfc_descriptor descriptor{d.tag,
                                    static_cast<uint16_t>(d.row),
                                    static_cast<uint16_t>(d.col),
                                    static_cast<uint8_t>(d.stop_level),
                                    static_cast<uint8_t>(d.format),
                                    static_cast<uint16_t>(d.x),
                                    static_cast<uint16_t>(d.y),
                                    static_cast<uint16_t>(d.width),
                                    static_cast<uint16_t>(d.height),
                                    d.destination,
                                    d.pitch,
                                    d.bitmap};
  check(hmlfc_unit_give(driver(), &descriptor), "give");
}

hmlfc_status ViewHost::wait() {
  hmlfc_status status{};
  if (hmlfc_unit_wait(driver(), &status) != HMLFC_OK) find("hang: a descriptor");
  return status;
}

hmlfc_status ViewHost::run(const Descriptor& descriptor) {
  give(descriptor);
  return wait();
}

}  // namespace hmlfc::tb
