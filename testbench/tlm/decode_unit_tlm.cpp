#include "tlm/decode_unit_tlm.hpp"

#include <algorithm>
#include <cstring>

namespace hmlfc::tb {
namespace {

constexpr uint64_t kBurstBytes = 256;

// An access that is not as the socket's contract has it.
bool refuse(tlm::tlm_generic_payload& access, bool good, tlm::tlm_response_status status) {
  if (!good) access.set_response_status(status);
  return !good;
}

}  // namespace

DecodeUnitTlm::DecodeUnitTlm(const sc_core::sc_module_name& name, const UnitParameters& parameters,
                             const sc_core::sc_time& period)
    : sc_core::sc_module(name),
      registers("registers"),
      requests("requests"),
      answers("answers"),
      memory("memory"),
      parameters_(parameters),
      period_(period),
      file_(parameters) {
  registers.register_b_transport(this, &DecodeUnitTlm::access_registers);
  requests.register_b_transport(this, &DecodeUnitTlm::take_request);
}

void DecodeUnitTlm::reset() {
  file_ = RegisterFile(parameters_);
  oracle_.reset();
  golden_.reset();
  stream_.clear();
}

void DecodeUnitTlm::access_registers(tlm::tlm_generic_payload& access, sc_core::sc_time& delay) {
  const bool whole = access.get_data_length() == 4 && access.get_byte_enable_ptr() == nullptr;
  if (refuse(access, whole && access.get_address() % 4 == 0, tlm::TLM_BURST_ERROR_RESPONSE)) return;
  const auto offset = static_cast<uint32_t>(access.get_address());
  uint32_t value = 0;
  delay += period_;
  if (access.is_write()) {
    std::memcpy(&value, access.get_data_ptr(), sizeof(value));
    control(file_.write(offset, value), delay);
  } else if (access.is_read()) {
    value = file_.read(offset);
    std::memcpy(access.get_data_ptr(), &value, sizeof(value));
  }
  access.set_response_status(tlm::TLM_OK_RESPONSE);
}

void DecodeUnitTlm::control(uint32_t bits, sc_core::sc_time& delay) {
  if ((bits & HMLFC_REG_CONTROL_DISABLE_MASK) != 0) {
    oracle_.reset();
    file_.ready = false;
  }
  if ((bits & HMLFC_REG_CONTROL_LOAD_MASK) != 0) load(delay);
}

void DecodeUnitTlm::load(sc_core::sc_time& delay) {
  oracle_.reset();
  golden_.reset();
  file_.load_error = kBusError;
  if (read_stream(delay)) {
    auto opened = GoldenStream::open(stream_, parameters_);
    file_.load_error = opened ? 0 : static_cast<uint8_t>(opened.error().code);
    if (opened) golden_ = std::move(*opened);
  }
  file_.ready = golden_ != nullptr;
  oracle_ = golden_ ? std::make_unique<Oracle>(*golden_, &golden_->fast_references())
                    : std::make_unique<Oracle>(file_.load_error);
  delay += period_;
  loaded_.notify(delay);
}

bool DecodeUnitTlm::read_stream(sc_core::sc_time& delay) {
  stream_.assign(static_cast<size_t>(file_.stream_bytes()), 0);
  for (uint64_t at = 0; at < stream_.size(); at += kBurstBytes) {
    const auto burst = std::span(stream_).subspan(
        static_cast<size_t>(at), std::min<size_t>(kBurstBytes, stream_.size() - at));
    if (!transport(memory, tlm::TLM_READ_COMMAND, file_.stream_base() + at, burst, delay)) {
      return false;
    }
    file_.bytes_read += burst.size();
  }
  return true;
}

void DecodeUnitTlm::take_request(tlm::tlm_generic_payload& write, sc_core::sc_time& delay) {
  const bool good = write.is_write() && write.get_data_length() == kRequestBytes;
  if (refuse(write, good, tlm::TLM_BURST_ERROR_RESPONSE)) return;
  while (!oracle_) {
    sc_core::wait(loaded_);
    delay = sc_core::SC_ZERO_TIME;
  }
  uint64_t word = 0;
  std::memcpy(&word, write.get_data_ptr(), sizeof(word));
  const Request request = Request::of_word(word, write.get_data_ptr()[8] != 0);
  const ExpectedAnswer expected = oracle_->evaluate(request);
  delay += period_;
  ++file_.cycles;
  if (!expected.planes[0]) ++file_.blocks;  // refused
  for (const auto& plane : expected.planes) file_.blocks += plane ? plane->levels.size() : 0;
  file_.count_answer(word, expected.answer.status);
  answer(expected, delay);
  write.set_response_status(tlm::TLM_OK_RESPONSE);
}

void DecodeUnitTlm::answer(const ExpectedAnswer& expected, sc_core::sc_time& delay) {
  const unsigned length = answer_bytes(parameters_.block_size());
  std::vector<uint8_t> bytes(length);
  std::memcpy(bytes.data(), expected.answer.samples.data(), length - 2);
  bytes[length - 2] = expected.answer.status;
  bytes[length - 1] = expected.answer.last ? 1 : 0;
  transport(answers, tlm::TLM_WRITE_COMMAND, 0, bytes, delay);
}

}  // namespace hmlfc::tb
