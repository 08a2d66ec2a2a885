// The DMA of the view unit as Verilator made it, with the golden model as its decode unit.
#pragma once

#include <bit>
#include <deque>

#include "oracle/oracle.hpp"
#include "stimulus/conditions.hpp"
#include "unit/registers.hpp"
#include "unit/verilated_unit.hpp"

namespace hmlfc::tb {

/// `Model` is Verilator's class of hmlfc_view_dma. The model answers after a time and with pauses,
/// the same in each run; registers of the decode unit say that it is ready.
template <class Model>
class VerilatedDma final : public VerilatedUnit<Model> {
 public:
  /// `oracle` must outlive the unit.
  VerilatedDma(const UnitParameters& parameters, Oracle& oracle)
      : VerilatedUnit<Model>(parameters), oracle_(oracle) {
    this->model().m_request_tready = this->model().s_response_tvalid = 0;
  }

  void clock(const UnitInputs& inputs, UnitOutputs& out) override {
    Model& m = this->model();
    const bool asked = m.rst_n && m.m_request_tvalid && m.m_request_tready;
    const bool answered = m.rst_n && m.s_response_tvalid && m.s_response_tready;
    if (asked) requests_.push_back(Request::of_word(m.m_request_tdata, false));
    if (answered) requests_.pop_front();
    if (m.s_axil_arvalid && m.s_axil_arready) read_from_ = m.s_axil_araddr;
    const bool was_reset = !m.unit_rst_n;
    this->rise(m.busy || offered(m));
    this->set_inputs(inputs);
    m.fetch_arready = inputs.ar_ready;
    m.read_asked = m.fetch_arvalid && m.fetch_arready && m.unit_rst_n;
    m.accessed = m.fetch_arvalid && !m.fetch_arready;  // a read address that waits is not withdrawn
    m.read_ended = inputs.r_valid && inputs.r_last;
    m.read_moves = m.read_asked || inputs.r_valid;
    m.fetch_rvalid = inputs.r_valid;
    std::memcpy(&m.fetch_rdata, inputs.r_data.data(), sizeof(m.fetch_rdata));
    m.fetch_rresp = inputs.r_resp;
    m.fetch_rlast = inputs.r_last;
    const bool reset = !inputs.rst_n || was_reset;
    if (reset) requests_.clear();
    if (random_.chance(2)) slow_ = !slow_;
    m.m_request_tready = requests_.size() < 40 && !random_.chance(slow_ ? 900 : 300);
    show_answer(m, answered || reset);
    this->fall(out);
    if (read_from_ < HMLFC_REG_VIEW_ID) out.lite_r_data = decode_unit_register();
    out.ar_valid = m.fetch_arvalid && m.unit_rst_n;
    out.ar_addr = m.fetch_araddr;
    out.ar_len = m.fetch_arlen;
    out.ar_size = static_cast<uint8_t>(std::countr_zero(this->parameters().beat_bytes));
    out.ar_burst = 1;
    out.ar_id = 1;
    out.r_ready = true;
  }

 private:
  /// Whether one of the channels that wake hmlfc_view_unit offers something.
  static bool offered(const Model& m) {
    return m.rst_n == 0 || m.fetch_rvalid || m.m_axi_bvalid || m.s_axil_awvalid ||
           m.s_axil_wvalid || m.s_axil_arvalid;
  }

  void show_answer(Model& m, bool next) {
    if (m.s_response_tvalid && !next) return;
    m.s_response_tvalid = !requests_.empty() && !random_.chance(slow_ ? 800 : 100);
    if (!m.s_response_tvalid) return;
    const Answer answer = oracle_.evaluate(requests_.front()).answer;
    const unsigned b = this->parameters().block_size();
    std::memcpy(&m.s_response_tdata, answer.samples.data(), kLanes * b * b * 2);
    m.s_response_tuser = answer.status;
  }

  uint32_t decode_unit_register() const {
    const UnitParameters p = this->parameters();
    switch (read_from_) {
      case HMLFC_REG_ID:
        return HMLFC_REG_ID_RESET;
      case HMLFC_REG_PARAMETERS:
        return reg::parameters(p.block_log2, p.max_depth, p.beat_bytes);
      default:
        return read_from_ == HMLFC_REG_STATUS ? HMLFC_REG_STATUS_READY_MASK : 0;
    }
  }

  Oracle& oracle_;
  Random random_{5};
  bool slow_ = false;
  std::deque<Request> requests_;
  uint32_t read_from_ = 0;  // the address of the latest register read
};

}  // namespace hmlfc::tb
