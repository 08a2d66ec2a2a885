#include "tlm/tlm_platform.hpp"

#include <cstring>

namespace hmlfc::tb {

TlmPlatform::TlmPlatform(const sc_core::sc_module_name& name, const UnitParameters& parameters)
    : sc_core::sc_module(name),
      parameters_(parameters),
      scoreboard_("scoreboard", findings_, coverage_),
      unit_("unit", parameters),
      registers_("registers"),
      requests_("requests"),
      answers_("answers"),
      memory_("memory") {
  registers_.bind(unit_.registers);
  requests_.bind(unit_.requests);
  unit_.answers.bind(answers_);
  unit_.memory.bind(memory_);
  answers_.register_b_transport(this, &TlmPlatform::take_answer);
  memory_.register_b_transport(this, &TlmPlatform::read_memory);
  SC_HAS_PROCESS(TlmPlatform);
  SC_THREAD(software);
}

void TlmPlatform::run(const MemoryImage& image, uint8_t load_error, RequestSource source,
                      Oracle& oracle) {
  unit_.reset();
  findings_.begin(0);
  scoreboard_.clear();
  scoreboard_.expect_trace(false);
  scoreboard_.set_oracle(&oracle, parameters_.block_size());
  image_ = image;
  load_error_ = load_error;
  source_ = std::move(source);
  done_ = false;
  start_.notify(sc_core::SC_ZERO_TIME);
  while (!done_) sc_core::sc_start(1, sc_core::SC_US);
  scoreboard_.finish(answers_taken_);
}

void TlmPlatform::software() {
  while (true) {
    while (done_) wait(start_);
    load();
    while (const auto request = source_()) send(*request);
    if (access(tlm::TLM_READ_COMMAND, HMLFC_REG_REQUESTS, 0) !=
        static_cast<uint32_t>(scoreboard_.counts().received)) {
      findings_.add({"registers: REQUESTS", {}, {}, {}, answers_taken_});
    }
    done_ = true;
  }
}

void TlmPlatform::load() {
  const auto write = [&](uint32_t offset, uint32_t word) {
    access(tlm::TLM_WRITE_COMMAND, offset, word);
  };
  reg::write_stream(write, image_.stream_base, image_.stream.size(), image_.reference_base);
  access(tlm::TLM_WRITE_COMMAND, HMLFC_REG_CONTROL,
         HMLFC_REG_CONTROL_LOAD_MASK | HMLFC_REG_CONTROL_CLEAR_MASK);
  const uint32_t status = access(tlm::TLM_READ_COMMAND, HMLFC_REG_STATUS, 0);
  if (reg::load_error(status) == load_error_) return;
  findings_.add(
      {"registers: error of LOAD",
       {},
       {},
       "expected " + status_name(load_error_) + ", actual " + status_name(reg::load_error(status)),
       0});
}

uint32_t TlmPlatform::access(tlm::tlm_command command, uint32_t offset, uint32_t value) {
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  auto* const bytes = reinterpret_cast<uint8_t*>(&value);
  if (!transport(registers_, command, offset, {bytes, sizeof(value)}, delay)) {
    findings_.add({"registers: response", {}, std::to_string(offset), {}, answers_taken_});
  }
  wait(delay);
  return value;
}

void TlmPlatform::send(const Request& request) {
  std::array<unsigned char, kRequestBytes> bytes{};
  const uint64_t word = request.word();
  std::memcpy(bytes.data(), &word, sizeof(word));
  bytes[8] = request.last ? 1 : 0;
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  scoreboard_.on_request(request, answers_taken_);
  transport(requests_, tlm::TLM_WRITE_COMMAND, 0, bytes, delay);
  wait(delay);
}

void TlmPlatform::take_answer(tlm::tlm_generic_payload& write, sc_core::sc_time&) {
  Answer answer;
  const unsigned samples = write.get_data_length() - 2;
  std::memcpy(answer.samples.data(), write.get_data_ptr(), samples);
  answer.status = write.get_data_ptr()[samples];
  answer.last = write.get_data_ptr()[samples + 1] != 0;
  scoreboard_.on_answer(answer, ++answers_taken_);
  write.set_response_status(tlm::TLM_OK_RESPONSE);
}

void TlmPlatform::read_memory(tlm::tlm_generic_payload& read, sc_core::sc_time&) {
  const uint64_t at = read.get_address() - image_.stream_base;
  const uint64_t length = read.get_data_length();
  const bool there = at <= image_.stream.size() && length <= image_.stream.size() - at;
  if (there) std::memcpy(read.get_data_ptr(), image_.stream.data() + at, length);
  read.set_response_status(there ? tlm::TLM_OK_RESPONSE : tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

}  // namespace hmlfc::tb
