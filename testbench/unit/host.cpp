#include "unit/host.hpp"

#include <algorithm>
#include <utility>

namespace hmlfc::tb {
namespace {

constexpr uint64_t kAccessPatience = 10'000;  // clocks

}  // namespace

Host::Host(std::unique_ptr<Unit> unit, uint64_t draw)
    : space_(draw ^ unit->parameters().state_seed), unit_(std::move(unit)) {
  memory_.set_unit(unit_->parameters());
  memory_.start({.latency = 0}, 0);
}

void Host::find(const std::string& what) {
  if (!finding_.empty()) return;
  finding_ = what + " (HMLFC_RTL_STATE=" + std::to_string(unit_->state_seed()) + ")";
}

void Host::clock() {
  memory_.edge(in_, out_, next_);
  registers_.edge(in_, out_, next_);
  unit_->clock(next_, out_);
  in_ = next_;
  ++clocks_;
  if (out_.interrupt) ++interrupt_clocks_;
  if (!memory_.finding.empty()) find(memory_.finding);
  if (!registers_.finding.empty()) find(registers_.finding);
}

void Host::idle(uint64_t clocks) {
  while (clocks-- > 0) clock();
}

void Host::write(uint32_t address, uint32_t value) {
  registers_.start_write(address, value);
  finish_access();
}

uint32_t Host::read(uint32_t address) {
  registers_.start_read(address);
  return finish_access() ? registers_.value() : 0;
}

bool Host::finish_access() {
  for (uint64_t clocks = 0; !registers_.done(); ++clocks) {
    if (clocks == kAccessPatience) {
      find("hang: a register access");
      return false;
    }
    clock();
  }
  return true;
}

void Host::reset_unit() {
  next_ = {};
  idle(4);
  next_.rst_n = true;
  clock();
}

uint64_t Host::take_place(uint64_t bytes, uint64_t alignment, uint64_t behind) {
  bytes = std::max<uint64_t>(bytes, 1);
  const uint64_t address = space_.take(bytes, alignment, behind);
  memory_.content.add(address, bytes);
  return address;
}

}  // namespace hmlfc::tb
