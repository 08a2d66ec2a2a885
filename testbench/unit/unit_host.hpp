// The minimum around a decode unit: software's register accesses, a memory without faults, a queue
// of requests. There are no checks of answers: they come out unchanged.
#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "unit/host.hpp"

namespace hmlfc::tb {

/// Thrown when the unit makes no progress for too long, or breaks the rules of a channel.
class UnitHangs : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One unit with one stream in memory, at addresses that the stream's bytes and the state of the
/// unit draw. An example of how software drives the unit (docs/hardware.md, "Using it").
class UnitHost final : public Host {
 public:
  /// `area` is the reference area of `stream`.
  UnitHost(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream,
           std::span<const uint8_t> area);

  /// LOADs the stream; the error of STATUS, 0 for none. Throws UnitHangs.
  uint8_t load();

  /// The answers to `requests`, in their order. Throws UnitHangs.
  std::vector<Answer> answers(std::span<const Request> requests);

  /// Called with every trace record.
  std::function<void(const LevelRecord&)> on_record;

 private:
  uint64_t stream_bytes_;
  uint64_t stream_base_;
  uint64_t area_base_;
};

}  // namespace hmlfc::tb
