// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Shares one AXI4-Lite port between two subordinates by address bit 11: 0 is port a, 1 is port b.
//
// One write and one read at a time; the data of a write pass after its address. Nothing is registered but who has the
// access. `a_busy`: an access to port a is under way. With `a_closed` none begins: port b has those as well, at
// addresses that it does not know.
module hmlfc_axil_split (
    input logic clk,
    input logic rst_n,
    input logic a_closed,
    output logic a_busy,

    input logic s_awvalid,
    output logic s_awready,
    input logic [11:0] s_awaddr,
    input logic s_wvalid,
    output logic s_wready,
    output logic s_bvalid,
    input logic s_bready,
    input logic s_arvalid,
    output logic s_arready,
    input logic [11:0] s_araddr,
    output logic s_rvalid,
    input logic s_rready,
    output logic [31:0] s_rdata,

    // Port b in the high bit; addresses and data of writes are those of s_*.
    output logic [1:0] awvalid,
    input logic [1:0] awready,
    output logic [1:0] wvalid,
    input logic [1:0] wready,
    input logic [1:0] bvalid,
    output logic [1:0] bready,
    output logic [1:0] arvalid,
    input logic [1:0] arready,
    input logic [1:0] rvalid,
    output logic [1:0] rready,
    input logic [63:0] rdata
);

  logic writing, write_to, data_sent, reading, read_from;
  wire write_b = s_awaddr[11] || a_closed;
  wire read_b = s_araddr[11] || a_closed;
  assign a_busy = (writing && !write_to) || (reading && !read_from);
  wire [1:0] write_port = write_to ? 2'b10 : 2'b01;
  wire [1:0] read_port = read_from ? 2'b10 : 2'b01;

  assign awvalid = s_awvalid && !writing ? (write_b ? 2'b10 : 2'b01) : 2'b00;
  assign s_awready = !writing && (write_b ? awready[1] : awready[0]);
  assign wvalid = s_wvalid && writing && !data_sent ? write_port : 2'b00;
  assign s_wready = writing && !data_sent && (wready & write_port) != 0;
  assign s_bvalid = writing && (bvalid & write_port) != 0;
  assign bready = s_bready && writing ? write_port : 2'b00;

  assign arvalid = s_arvalid && !reading ? (read_b ? 2'b10 : 2'b01) : 2'b00;
  assign s_arready = !reading && (read_b ? arready[1] : arready[0]);
  assign s_rvalid = reading && (rvalid & read_port) != 0;
  assign rready = s_rready && reading ? read_port : 2'b00;
  assign s_rdata = read_from ? rdata[63:32] : rdata[31:0];

  always_ff @(posedge clk) begin
    if (s_awvalid && s_awready) write_to <= write_b;
    if (s_arvalid && s_arready) read_from <= read_b;
    if (!rst_n) begin
      writing <= 1'b0;
      data_sent <= 1'b0;
      reading <= 1'b0;
    end else begin
      if (s_awvalid && s_awready) writing <= 1'b1;
      else if (s_bvalid && s_bready) writing <= 1'b0;
      data_sent <= writing && (data_sent || (s_wvalid && s_wready)) && !(s_bvalid && s_bready);
      if (s_arvalid && s_arready) reading <= 1'b1;
      else if (s_rvalid && s_rready) reading <= 1'b0;
    end
  end

endmodule

`default_nettype wire
