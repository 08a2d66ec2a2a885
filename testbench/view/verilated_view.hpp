// The view unit, and its DMA alone, as Verilator made them.
#pragma once

#include <cstring>
#include <deque>
#include <memory>

#include <verilated.h>

#include "oracle/oracle.hpp"
#include "stimulus/conditions.hpp"
#include "unit/clock_gate.hpp"
#include "unit/initial_state.hpp"
#include "unit/plusargs.hpp"
#include "view/view_pins.hpp"

namespace hmlfc::tb {

/// Registers and write master, which both have.
template <class Model>
void set_shared_inputs(Model& m, const ViewInputs& in) {
  m.rst_n = in.rst_n;
  m.m_axi_awready = in.write_aw_ready;
  m.m_axi_wready = in.write_w_ready;
  m.m_axi_bvalid = in.write_b_valid;
  m.m_axi_bresp = in.write_b_resp;
  m.s_axil_awvalid = in.aw_valid;
  m.s_axil_awaddr = static_cast<uint16_t>(in.aw_addr);
  m.s_axil_wvalid = in.w_valid;
  m.s_axil_wdata = in.w_data;
  m.s_axil_wstrb = in.w_strb;
  m.s_axil_bready = in.b_ready;
  m.s_axil_arvalid = in.lite_ar_valid;
  m.s_axil_araddr = static_cast<uint16_t>(in.lite_ar_addr);
  m.s_axil_rready = in.lite_r_ready;
}

template <class Model>
void get_shared_outputs(const Model& m, ViewOutputs& out) {
  out.write_aw_valid = m.m_axi_awvalid != 0;
  out.write_aw_addr = m.m_axi_awaddr;
  out.write_aw_len = m.m_axi_awlen;
  out.write_aw_size = m.m_axi_awsize;
  out.write_aw_burst = m.m_axi_awburst;
  out.write_w_valid = m.m_axi_wvalid != 0;
  std::memcpy(out.write_w_data.data(), &m.m_axi_wdata, sizeof(m.m_axi_wdata));
  out.write_w_strb = m.m_axi_wstrb;
  out.write_w_last = m.m_axi_wlast != 0;
  out.write_b_ready = m.m_axi_bready != 0;
  out.aw_ready = m.s_axil_awready != 0;
  out.w_ready = m.s_axil_wready != 0;
  out.b_valid = m.s_axil_bvalid != 0;
  out.lite_ar_ready = m.s_axil_arready != 0;
  out.lite_r_valid = m.s_axil_rvalid != 0;
  out.lite_r_data = m.s_axil_rdata;
  out.interrupt = m.irq != 0;
}

/// `Model` is Verilator's class of hmlfc_view_unit.
template <class Model>
class VerilatedView final : public ViewUnit {
 public:
  explicit VerilatedView(const UnitParameters& parameters)
      : parameters_(parameters), state_(context_, parameters.state_seed) {
    take_plusargs(context_);
    model_ = std::make_unique<Model>(&context_, state_.setting().c_str());
    set_inputs(ViewInputs{});
    model_->clk = 0;
    model_->eval();
  }
  ~VerilatedView() override { model_->final(); }

  void clock(const ViewInputs& after, ViewOutputs& out) override {
    Model& m = *model_;
    if (gate_.passes(m.rst_n != 0, m.active != 0)) m.clk = 1;
    m.eval();
    state_.after_edge();
    set_inputs(after);
    m.clk = 0;
    m.eval();
    get_shared_outputs(m, out);
    out.ar_valid = m.m_axi_arvalid != 0;
    out.ar_addr = m.m_axi_araddr;
    out.ar_len = m.m_axi_arlen;
    out.ar_size = m.m_axi_arsize;
    out.ar_burst = m.m_axi_arburst;
    out.ar_id = m.m_axi_arid;
    out.r_ready = m.m_axi_rready != 0;
  }

  bool reads_stream() const override { return true; }
  UnitParameters parameters() const override { return parameters_; }
  uint32_t state_seed() const override { return state_.seed(); }
  uint64_t stopped_clocks() const override { return gate_.stopped(); }

 private:
  void set_inputs(const ViewInputs& in) {
    Model& m = *model_;
    set_shared_inputs(m, in);
    m.m_axi_arready = in.ar_ready;
    m.m_axi_rvalid = in.r_valid;
    std::memcpy(&m.m_axi_rdata, in.r_data.data(), sizeof(m.m_axi_rdata));
    m.m_axi_rresp = in.r_resp;
    m.m_axi_rlast = in.r_last;
    m.m_axi_rid = in.r_id;
  }

  UnitParameters parameters_;
  ClockGate gate_;
  VerilatedContext context_;
  InitialState state_;
  std::unique_ptr<Model> model_;
};

/// `Model` is Verilator's class of hmlfc_view_dma; the golden model answers in place of the decode
/// unit, after a time and with pauses by `seed`.
template <class Model>
class VerilatedDma final : public ViewUnit {
 public:
  /// `oracle` must outlive the unit.
  VerilatedDma(const UnitParameters& parameters, Oracle& oracle, uint64_t seed)
      : parameters_(parameters),
        oracle_(oracle),
        random_(seed),
        state_(context_, parameters.state_seed) {
    take_plusargs(context_);
    model_ = std::make_unique<Model>(&context_, state_.setting().c_str());
    set_inputs(ViewInputs{});
    model_->m_request_tready = model_->s_response_tvalid = 0;
    model_->clk = 0;
    model_->eval();
  }
  ~VerilatedDma() override { model_->final(); }

  void clock(const ViewInputs& after, ViewOutputs& out) override {
    Model& m = *model_;
    const bool asked = m.rst_n && m.m_request_tvalid && m.m_request_tready;
    const bool answered = m.rst_n && m.s_response_tvalid && m.s_response_tready;
    if (asked) requests_.push_back(Request::of_word(m.m_request_tdata, false));
    if (answered) requests_.pop_front();
    if (gate_.passes(m.rst_n != 0, m.busy || offered(m))) m.clk = 1;
    m.eval();
    state_.after_edge();
    set_inputs(after);
    if (!after.rst_n) requests_.clear();
    const bool slow = random_.chance(2) ? !slow_ : slow_;
    slow_ = slow;
    m.m_request_tready = requests_.size() < 40 && !random_.chance(slow ? 900 : 300);
    show_answer(m, answered || !after.rst_n, slow);
    m.clk = 0;
    m.eval();
    get_shared_outputs(m, out);
    out.ar_valid = m.fetch_arvalid != 0;
    out.ar_addr = m.fetch_araddr;
    out.ar_len = m.fetch_arlen;
    out.ar_size = parameters_.beat_bytes == 16 ? 4 : 3;
    out.ar_burst = 1;
    out.ar_id = 1;
    out.r_ready = true;
  }

  bool reads_stream() const override { return false; }
  UnitParameters parameters() const override { return parameters_; }
  uint32_t state_seed() const override { return state_.seed(); }
  uint64_t stopped_clocks() const override { return gate_.stopped(); }

 private:
  void set_inputs(const ViewInputs& in) {
    Model& m = *model_;
    set_shared_inputs(m, in);
    m.fetch_arready = in.ar_ready;
    m.fetch_rvalid = in.r_valid;
    std::memcpy(&m.fetch_rdata, in.r_data.data(), sizeof(m.fetch_rdata));
    m.fetch_rresp = in.r_resp;
    m.fetch_rlast = in.r_last;
  }

  /// Of the channels that wake hmlfc_view_unit.
  static bool offered(const Model& m) {
    return m.rst_n == 0 || m.fetch_rvalid || m.m_axi_bvalid || m.s_axil_awvalid ||
           m.s_axil_wvalid || m.s_axil_arvalid;
  }

  void show_answer(Model& m, bool next, bool slow) {
    if (m.s_response_tvalid && !next) return;
    m.s_response_tvalid = !requests_.empty() && !random_.chance(slow ? 800 : 100);
    if (!m.s_response_tvalid) return;
    const Answer answer = oracle_.evaluate(requests_.front()).answer;
    std::memcpy(&m.s_response_tdata, answer.samples.data(),
                kLanes * parameters_.block_size() * parameters_.block_size() * 2);
    m.s_response_tuser = answer.status;
  }

  UnitParameters parameters_;
  Oracle& oracle_;
  Random random_;
  bool slow_ = false;
  ClockGate gate_;
  std::deque<Request> requests_;
  VerilatedContext context_;
  InitialState state_;
  std::unique_ptr<Model> model_;
};

}  // namespace hmlfc::tb
