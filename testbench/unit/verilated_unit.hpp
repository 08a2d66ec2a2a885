// A unit as Verilator made it, connected to the pins of the bench.
#pragma once

#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>

#include <verilated.h>
#include <verilated_cov.h>
#if VM_TRACE
#include <verilated_fst_c.h>
#endif

#include "unit/pins.hpp"
#include "unit/simulation.hpp"

namespace hmlfc::tb {

#if VM_TRACE
/// The wave of a unit, from open() on; a unit that was not Verilated for waves has none.
class Wave {
 public:
  template <class Model>
  bool open(Model& model, const std::string& path) {
    if constexpr (requires(VerilatedFstC * file) { model.trace(file, 99); }) {
      file_ = std::make_unique<VerilatedFstC>();
      model.trace(file_.get(), 99);
      file_->open(path.c_str());
      return true;
    }
    return false;
  }
  void dump(uint64_t time) {
    if (file_) file_->dump(time);
  }
  void close() {
    if (file_) file_->close();
  }

 private:
  std::unique_ptr<VerilatedFstC> file_;
};
#else
/// No unit of this build has waves.
struct Wave {
  template <class Model>
  bool open(Model&, const std::string&) {
    return false;
  }
  void dump(uint64_t) {}
  void close() {}
};
#endif

/// A port of any width, as words of 32 bits.
template <class Port>
const uint32_t* port_words(const Port& port) {
  if constexpr (std::is_integral_v<Port>) {
    return reinterpret_cast<const uint32_t*>(&port);  // of at least 32 bits
  } else {
    return port.data();
  }
}

/// Splits a port into `count` samples of `bits` in [1, 16] bits in two's complement, lowest first.
inline void unpack_samples(const uint32_t* words, unsigned bits, size_t count, int16_t* out) {
  uint64_t held = 0;
  unsigned have = 0;
  const unsigned up = 64 - bits;
  for (size_t i = 0; i < count; ++i) {
    if (have < bits) {
      held |= uint64_t{*words++} << have;
      have += 32;
    }
    out[i] = static_cast<int16_t>(static_cast<int64_t>(held << up) >> up);
    held >>= bits;
    have -= bits;
  }
}

/// Writes what the unit of `context` has covered into a file of the folder that the environment
/// variable HMLFC_RTL_COVERAGE_DIR names; does nothing without it.
inline void write_coverage(VerilatedContext& context) {
  static int files = 0;
  const char* folder = std::getenv("HMLFC_RTL_COVERAGE_DIR");
  if (folder == nullptr) return;
  const std::string path = std::string(folder) + "/" + std::to_string(files++) + ".dat";
  context.coveragep()->write(path.c_str());
}

/// `Model` is Verilator's class of hmlfc_decode_unit or hmlfc_view_unit for `parameters`.
template <class Model>
class VerilatedUnit : public Unit {
 public:
  explicit VerilatedUnit(const UnitParameters& parameters)
      : parameters_(parameters), simulation_(parameters.state_seed) {
    simulation_.context().traceEverOn(VM_TRACE);
    model_ = std::make_unique<Model>(&simulation_.context(), simulation_.setting().c_str());
    set_inputs(UnitInputs{});
    model_->clk = 0;
    model_->eval();
  }

  ~VerilatedUnit() override {
    wave_.close();
    model_->final();
    if constexpr (VM_COVERAGE) write_coverage(simulation_.context());
    // Scopes of the checker are taken out of the context of this thread: that of the latest unit.
    Verilated::threadContextp(&simulation_.context());
  }

  void clock(const UnitInputs& inputs, UnitOutputs& outputs) override {
    if constexpr (requires { model_->active; }) rise(model_->active != 0);
    set_inputs(inputs);
    fall(outputs);
  }

  UnitParameters parameters() const override { return parameters_; }
  uint32_t state_seed() const override { return simulation_.seed(); }
  uint64_t stopped_clocks() const override { return simulation_.stopped(); }
  bool open_wave(const std::string& path) override { return wave_.open(*model_, path); }

 protected:
  Model& model() { return *model_; }

  /// The rising edge. A unit that is not `active` does not need it.
  void rise(bool active) {
    if (simulation_.passes(model_->rst_n != 0, active)) model_->clk = 1;
    model_->eval();
    simulation_.after_edge();
    dump();
  }

  /// The falling edge, after which the outputs follow from the inputs.
  void fall(UnitOutputs& out) {
    model_->clk = 0;
    model_->eval();
    dump();
    get_registers(out);
    if constexpr (requires { model_->s_request_tready; }) get_stream(out);
    if constexpr (requires { model_->m_axi_arready; }) get_reads(out);
    if constexpr (requires { model_->m_axi_awready; }) get_writes(out);
  }

  void set_inputs(const UnitInputs& in) {
    Model& m = *model_;
    m.rst_n = in.rst_n;
    m.s_axil_awvalid = in.aw_valid;
    m.s_axil_awaddr = static_cast<uint16_t>(in.aw_addr);
    m.s_axil_wvalid = in.w_valid;
    m.s_axil_wdata = in.w_data;
    m.s_axil_wstrb = in.w_strb;
    m.s_axil_bready = in.b_ready;
    m.s_axil_arvalid = in.lite_ar_valid;
    m.s_axil_araddr = static_cast<uint16_t>(in.lite_ar_addr);
    m.s_axil_rready = in.lite_r_ready;
    if constexpr (requires { m.s_request_tready; }) {
      m.s_request_tvalid = in.request_valid;
      m.s_request_tdata = in.request_data;
      m.s_request_tlast = in.request_last;
      m.m_response_tready = in.response_ready;
    }
    if constexpr (requires { m.m_axi_arready; }) {
      m.m_axi_arready = in.ar_ready;
      m.m_axi_rvalid = in.r_valid;
      std::memcpy(&m.m_axi_rdata, in.r_data.data(), sizeof(m.m_axi_rdata));
      m.m_axi_rresp = in.r_resp;
      m.m_axi_rlast = in.r_last;
      m.m_axi_rid = in.r_id;
    }
    if constexpr (requires { m.m_axi_awready; }) {
      m.m_axi_awready = in.write_aw_ready;
      m.m_axi_wready = in.write_w_ready;
      m.m_axi_bvalid = in.write_b_valid;
      m.m_axi_bresp = in.write_b_resp;
    }
  }

 private:
  void dump() {
    wave_.dump(time_);
    time_ += 5;
  }

  void get_registers(UnitOutputs& out) {
    const Model& m = *model_;
    out.aw_ready = m.s_axil_awready != 0;
    out.w_ready = m.s_axil_wready != 0;
    out.b_valid = m.s_axil_bvalid != 0;
    out.lite_ar_ready = m.s_axil_arready != 0;
    out.lite_r_valid = m.s_axil_rvalid != 0;
    out.lite_r_data = m.s_axil_rdata;
    if constexpr (requires { m.s_axil_bresp; }) {
      out.b_resp = m.s_axil_bresp;
      out.lite_r_resp = m.s_axil_rresp;
    }
    if constexpr (requires { m.irq; }) out.interrupt = m.irq != 0;
  }

  void get_stream(UnitOutputs& out) {
    const Model& m = *model_;
    out.request_ready = m.s_request_tready != 0;
    out.response_valid = m.m_response_tvalid != 0;
    if (out.response_valid) get_answer(out.answer);
    out.trace_valid = m.trace_valid != 0;
    if (out.trace_valid) get_trace(out.trace);
  }

  void get_reads(UnitOutputs& out) {
    const Model& m = *model_;
    out.ar_valid = m.m_axi_arvalid != 0;
    out.ar_addr = m.m_axi_araddr;
    out.ar_len = m.m_axi_arlen;
    out.ar_size = m.m_axi_arsize;
    out.ar_burst = m.m_axi_arburst;
    out.ar_id = m.m_axi_arid;
    out.r_ready = m.m_axi_rready != 0;
  }

  void get_writes(UnitOutputs& out) {
    const Model& m = *model_;
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
  }

  size_t samples() const { return size_t{1} << (2 * parameters_.block_log2); }

  void get_answer(Answer& answer) {
    const Model& m = *model_;
    answer.status = m.m_response_tuser;
    answer.last = m.m_response_tlast != 0;
    std::memcpy(answer.samples.data(), &m.m_response_tdata, kLanes * samples() * 2);
  }

  static int32_t component(unsigned field) {
    return static_cast<int32_t>(field ^ 256) - 256;  // 9 bits, signed
  }

  void get_trace(LevelRecord& r) {
    const Model& m = *model_;
    r.site = {m.trace_level, m.trace_row, m.trace_col, static_cast<Plane>(m.trace_plane),
              m.trace_bx,    m.trace_by};
    r.key = m.trace_key != 0;
    r.motion = m.trace_motion != 0;
    r.negative = m.trace_negative != 0;
    r.references = m.trace_references;
    r.vectors[0] = {component(m.trace_ix_a), component(m.trace_iy_a), m.trace_fx_a, m.trace_fy_a};
    r.vectors[1] = {component(m.trace_ix_b), component(m.trace_iy_b), m.trace_fx_b, m.trace_fy_b};
    r.has_residual = m.trace_has_residual != 0;
    r.error = m.trace_error;
    const unsigned bits = parameters_.max_depth;
    unpack_samples(port_words(m.trace_residual), bits + 2, samples(), r.residual.data());
    unpack_samples(port_words(m.trace_reference), bits + 2, samples(), r.reference.data());
    unpack_samples(port_words(m.trace_prediction), bits + 1, samples(), r.prediction.data());
    unpack_samples(port_words(m.trace_sample), bits + 1, samples(), r.sample.data());
  }

  UnitParameters parameters_;
  Simulation simulation_;
  std::unique_ptr<Model> model_;
  Wave wave_;
  uint64_t time_ = 0;
};

}  // namespace hmlfc::tb
