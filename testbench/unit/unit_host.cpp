#include "unit/unit_host.hpp"

#include <algorithm>
#include <utility>

#include "bits/crc32c.hpp"
#include "oracle/reference_area.hpp"
#include "unit/registers.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kMaxTries = 1'000'000;  // clocks without an answer, or reads of STATUS

}  // namespace

UnitHost::UnitHost(std::unique_ptr<Unit> unit, std::span<const uint8_t> stream,
                   std::span<const uint8_t> area)
    : Host(std::move(unit), crc32c(stream)),
      stream_bytes_(stream.size()),
      stream_base_(take_stream_place(stream.size())),
      area_base_(take_place(area.size(), kStripBytes, 0)) {
  std::ranges::copy(stream, memory().content.at(stream_base_).begin());
  std::ranges::copy(area, memory().content.at(area_base_).begin());
  reset_unit();
}

uint8_t UnitHost::load() {
  reg::write_stream([&](uint32_t address, uint32_t word) { write(address, word); }, stream_base_,
                    stream_bytes_, area_base_);
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  for (uint64_t reads = 0; reads < kMaxTries && finding().empty(); ++reads) {
    const uint32_t status = read(HMLFC_REG_STATUS);
    if ((status & HMLFC_REG_STATUS_LOADING_MASK) != 0) continue;
    if ((status & HMLFC_REG_STATUS_READY_MASK) != 0) return 0;
    if (reg::load_error(status) != 0) return static_cast<uint8_t>(reg::load_error(status));
  }
  find("hang: LOAD does not end");
  throw UnitHangs(finding());
}

std::vector<Answer> UnitHost::answers(std::span<const Request> requests) {
  std::vector<Answer> answers;
  size_t sent = 0;
  next_.response_ready = true;
  for (uint64_t idle = 0; answers.size() < requests.size(); ++idle) {
    if (idle == kMaxTries) find("hang: a request is not answered");
    if (!finding().empty()) throw UnitHangs(finding());
    next_.request_valid = sent < requests.size();
    if (next_.request_valid) {
      next_.request_data = requests[sent].word();
      next_.request_last = sent + 1 == requests.size();
    }
    clock();
    if (out_.trace_valid && on_record) on_record(out_.trace);
    // A handshake seen now completes at the next clock edge.
    if (in_.request_valid && out_.request_ready) ++sent;
    if (in_.response_ready && out_.response_valid) {
      answers.push_back(out_.answer);
      idle = 0;
    }
  }
  next_.request_valid = next_.response_ready = false;
  clock();
  return answers;
}

}  // namespace hmlfc::tb
