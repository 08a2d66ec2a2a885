// The decode unit as a TLM-2.0 model for the bring-up of software on virtual platforms: loosely
// timed, with the model's decoder and its fast references inside.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <memory>
#include <span>
#include <systemc>
#include <tlm>
#include <vector>

#include "oracle/oracle.hpp"
#include "tlm/register_file.hpp"

namespace hmlfc::tb {

/// One access through an initiator socket; whether it was good.
template <class Socket>
bool transport(Socket& socket, tlm::tlm_command command, uint64_t address, std::span<uint8_t> bytes,
               sc_core::sc_time& delay) {
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(static_cast<unsigned>(bytes.size()));
  payload.set_streaming_width(static_cast<unsigned>(bytes.size()));
  socket->b_transport(payload, delay);
  return payload.is_response_ok();
}

/// Bytes of a request: `tdata`, little-endian, then `tlast`.
inline constexpr unsigned kRequestBytes = 9;

/// Bytes of an answer of a unit with blocks of `block_size`: `tdata`, then `tuser`, then `tlast`.
constexpr unsigned answer_bytes(unsigned block_size) { return 3 * block_size * block_size * 2 + 2; }

/// Registers, requests and answers as in docs/decode_unit.md. At LOAD the whole stream is read
/// through `memory` and checked; a failing access there gives bus_error. The reference area is not
/// read: the model decodes the reference images itself. BYTES_READ counts what LOAD read, CYCLES
/// requests, STALLS is 0.
///
/// Time says nothing about the unit: an access, a LOAD and a request take a clock each.
///
/// A request is answered before its b_transport returns; the delay is annotated on the answer.
/// Before LOAD, and after DISABLE, it waits: call from a thread.
class DecodeUnitTlm final : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<DecodeUnitTlm> registers;   ///< 4 bytes at offsets of the table
  tlm_utils::simple_target_socket<DecodeUnitTlm> requests;    ///< writes of kRequestBytes
  tlm_utils::simple_initiator_socket<DecodeUnitTlm> answers;  ///< writes of answer_bytes()
  tlm_utils::simple_initiator_socket<DecodeUnitTlm> memory;   ///< reads of the stream

  DecodeUnitTlm(const sc_core::sc_module_name& name, const UnitParameters& parameters,
                const sc_core::sc_time& period = sc_core::sc_time(1, sc_core::SC_NS));

  /// Resets, as rst_n does.
  void reset();

 private:
  void access_registers(tlm::tlm_generic_payload& access, sc_core::sc_time& delay);
  void take_request(tlm::tlm_generic_payload& write, sc_core::sc_time& delay);
  void control(uint32_t bits, sc_core::sc_time& delay);
  void load(sc_core::sc_time& delay);
  bool read_stream(sc_core::sc_time& delay);
  void answer(const ExpectedAnswer& expected, sc_core::sc_time& delay);

  UnitParameters parameters_;
  sc_core::sc_time period_;
  RegisterFile file_;
  std::vector<uint8_t> stream_;
  std::unique_ptr<GoldenStream> golden_;
  std::unique_ptr<Oracle> oracle_;
  sc_core::sc_event loaded_;
};

}  // namespace hmlfc::tb
