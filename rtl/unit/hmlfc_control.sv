// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Software's interface: the registers, and LOAD, which reads and checks the stream's header.
//
// `enable`: requests may be accepted, as a LOAD has ended, with `load_error` or 0. `flush` is high for one clock when
// all state of the last stream must be discarded. `loading`: a LOAD is under way. Inputs for the counters: blocks of a
// level, answers with their error and request, clocks in which an answer waits, beats of the read master.
module hmlfc_control #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    localparam int LEVELS = hmlfc_pkg::LEVELS,
    localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic s_axil_awvalid,
    output logic s_axil_awready,
    input logic [11:0] s_axil_awaddr,
    input logic s_axil_wvalid,
    output logic s_axil_wready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    output logic s_axil_bvalid,
    input logic s_axil_bready,
    output logic [1:0] s_axil_bresp,
    input logic s_axil_arvalid,
    output logic s_axil_arready,
    input logic [11:0] s_axil_araddr,
    output logic s_axil_rvalid,
    input logic s_axil_rready,
    output logic [31:0] s_axil_rdata,
    output logic [1:0] s_axil_rresp,

    input logic idle,  // no request is in flight
    input logic reading,  // a read is
    input logic stray,  // a beat came that nothing asked for
    output logic loading,
    output logic enable,
    output logic [5:0] load_error,
    output logic flush,
    output hmlfc_pkg::config_t stream,
    output logic [LEVELS*LEVEL_BITS-1:0] levels,

    input logic block_done,
    input logic answered,
    input logic [5:0] answer_error,
    input logic [63:0] answered_request,
    input logic stalled,
    input logic beat,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  logic [63:0] stream_base, stream_bytes, reference_base;
  logic load, disable_unit;
  hmlfc_registers #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .AXI_DATA_BITS(DATA_BITS)) registers (
      .clk, .rst_n, .s_axil_awaddr, .s_axil_araddr, .s_axil_awvalid, .s_axil_awready, .s_axil_wdata, .s_axil_wstrb,
      .s_axil_wvalid, .s_axil_wready, .s_axil_bresp, .s_axil_bvalid, .s_axil_bready, .s_axil_arvalid, .s_axil_arready,
      .s_axil_rdata, .s_axil_rresp, .s_axil_rvalid, .s_axil_rready, .stream_base, .stream_bytes, .reference_base,
      .load, .disable_unit, .ready(enable && load_error == 0), .loading, .idle(idle && !reading), .stray, .load_error,
      .error_valid(answered && answer_error != 0), .error(answer_error), .error_request(answered_request), .block_done,
      .in_flight(!idle), .stalled, .read_bytes(beat ? 6'(DATA_BITS / 8) : 6'd0), .answered
  );
  hmlfc_loader #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(DATA_BITS)) loader (
      .clk, .rst_n, .load, .disable_unit, .idle, .loading, .enable, .flush, .error(load_error), .stream_base,
      .stream_bytes, .reference_base, .stream, .levels, .request, .response, .data
  );

endmodule

`default_nettype wire
