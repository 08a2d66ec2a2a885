// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// An AXI4 write master for lines of 64 bytes: each is one INCR burst of the beats from its first to its last strobe.
//
// A line is taken when valid and ready are both high, and needs at least one strobe. Addresses and data do not wait for
// each other; at most OUTSTANDING bursts await their response. All have ID 0, so that responses come in the order of
// the lines: `answered` is high for one clock for each, with the line's kind, and `failed` with it for SLVERR or
// DECERR. `idle`: all lines have their response.
module hmlfc_write_port #(
    parameter int DATA_BITS = 128,
    parameter int OUTSTANDING = 16,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic line_valid,
    output logic line_ready,
    input logic [ADDRESS_BITS-7:0] line,
    input logic [511:0] line_data,
    input logic [63:0] line_strobe,
    input logic [1:0] line_kind,
    output logic idle,
    output logic answered,
    output logic [1:0] answered_kind,
    output logic failed,

    output logic m_axi_awvalid,
    input logic m_axi_awready,
    output logic [ADDRESS_BITS-1:0] m_axi_awaddr,
    output logic [7:0] m_axi_awlen,
    output logic [2:0] m_axi_awsize,
    output logic [1:0] m_axi_awburst,
    output logic m_axi_wvalid,
    input logic m_axi_wready,
    output logic [DATA_BITS-1:0] m_axi_wdata,
    output logic [DATA_BITS/8-1:0] m_axi_wstrb,
    output logic m_axi_wlast,
    input logic m_axi_bvalid,
    output logic m_axi_bready,
    input logic [1:0] m_axi_bresp
);

  localparam int BYTES = DATA_BITS / 8;
  localparam int BEATS = 64 / BYTES;
  localparam int BEAT_BITS = $clog2(BEATS);

  // The first and the last beat with strobes.
  logic [BEAT_BITS-1:0] first, last;
  always_comb begin
    first = '0;
    last = '0;
    for (int i = 0; i < BEATS; i++) begin
      if (line_strobe[BYTES*i+:BYTES] != 0) last = BEAT_BITS'(i);
      if (line_strobe[BYTES*(BEATS-1-i)+:BYTES] != 0) first = BEAT_BITS'(BEATS - 1 - i);
    end
  end

  logic [BEAT_BITS-1:0] beat, end_beat;
  logic [511:0] data;
  logic [63:0] strobe;
  logic room, waits;  // for another burst, for a response
  logic [1:0] kind;
  wire [BEAT_BITS-1:0] more = last - first;
  wire take = line_valid && line_ready;
  assign line_ready = !m_axi_awvalid && !m_axi_wvalid && room;
  assign idle = !m_axi_awvalid && !m_axi_wvalid && !waits && !answered;
  hmlfc_fifo #(.WIDTH(2), .DEPTH(OUTSTANDING)) bursts (
      .clk, .rst_n, .in_valid(take), .in_ready(room), .in_data(line_kind), .out_valid(waits),
      .out_ready(m_axi_bvalid), .out_data(kind), .count()
  );

  always_ff @(posedge clk) begin
    if (take) begin
      m_axi_awaddr <= {line, first, (6 - BEAT_BITS)'(0)};
      m_axi_awlen <= 8'(more);
      beat <= first;
      end_beat <= last;
      data <= line_data;
      strobe <= line_strobe;
    end else if (m_axi_wvalid && m_axi_wready) begin
      beat <= beat + 1'b1;
    end
    answered <= rst_n && waits && m_axi_bvalid;
    answered_kind <= kind;
    failed <= m_axi_bresp[1];
    if (!rst_n) begin
      m_axi_awvalid <= 1'b0;
      m_axi_wvalid <= 1'b0;
    end else begin
      m_axi_awvalid <= take || (m_axi_awvalid && !m_axi_awready);
      m_axi_wvalid <= take || (m_axi_wvalid && !(m_axi_wready && m_axi_wlast));
    end
  end
  assign m_axi_awsize = 3'(6 - BEAT_BITS);
  assign m_axi_awburst = 2'b01;
  assign m_axi_wdata = data[DATA_BITS*beat+:DATA_BITS];
  assign m_axi_wstrb = strobe[BYTES*beat+:BYTES];
  assign m_axi_wlast = beat == end_beat;
  assign m_axi_bready = 1'b1;

endmodule

`default_nettype wire
