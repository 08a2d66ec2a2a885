// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Block RAM of 2^SIZE_LOG2 bytes behind an AXI4 port of 64 bits and a port of single bytes, which goes first.
//
// Higher bits of an address are ignored. Bursts of reads pass one after the other, a beat a clock, and a manager that
// waits for them keeps `rready` high; so do bursts of writes. `byte_rdata` is there in the clock after `byte_read`.
module fpga_memory #(
    parameter int SIZE_LOG2 = 16
) (
    input logic clk,
    input logic rst_n,

    /* verilator lint_off UNUSEDSIGNAL */  // the other bits of addresses
    input logic arvalid,
    output logic arready,
    input logic [hmlfc_pkg::ADDRESS_BITS-1:0] araddr,
    input logic [7:0] arlen,
    input logic arid,
    output logic rvalid,
    output logic [63:0] rdata,
    output logic rlast,
    output logic rid,

    input logic awvalid,
    output logic awready,
    input logic [hmlfc_pkg::ADDRESS_BITS-1:0] awaddr,
    input logic wvalid,
    output logic wready,
    input logic [63:0] wdata,
    input logic [7:0] wstrb,
    input logic wlast,
    output logic bvalid,
    input logic bready,
    /* verilator lint_on UNUSEDSIGNAL */

    input logic byte_read,
    input logic byte_write,
    input logic [SIZE_LOG2-1:0] byte_address,
    input logic [7:0] byte_wdata,
    output logic [7:0] byte_rdata
);
  localparam int PLACE_BITS = SIZE_LOG2 - 3;

  // ---- Reads.
  logic reading;
  logic [PLACE_BITS-1:0] read_place;
  logic [7:0] more;
  logic [2:0] lane;
  wire read_beat = reading && !byte_read;
  assign arready = !reading;
  assign byte_rdata = rdata[8*lane+:8];
  always_ff @(posedge clk) begin
    if (byte_read) lane <= byte_address[2:0];
    rvalid <= read_beat;
    rlast <= more == 0;
    if (arready) begin
      read_place <= araddr[SIZE_LOG2-1:3];
      more <= arlen;
      if (arvalid) rid <= arid;
      reading <= arvalid;
    end else if (read_beat) begin
      read_place <= read_place + 1'b1;
      more <= more - 8'd1;
      reading <= more != 0;
    end
    if (!rst_n) {reading, rvalid} <= '0;
  end

  // ---- Writes.
  logic writing;
  logic [PLACE_BITS-1:0] write_place;
  assign awready = !writing;
  assign wready = writing && !bvalid && !byte_write;
  wire write_beat = wvalid && wready;
  always_ff @(posedge clk) begin
    if (awready) begin
      write_place <= awaddr[SIZE_LOG2-1:3];
      writing <= awvalid;
    end
    if (write_beat) begin
      write_place <= write_place + 1'b1;
      bvalid <= wlast;
    end
    if (bvalid && bready) {writing, bvalid} <= '0;
    if (!rst_n) {writing, bvalid} <= '0;
  end

  // ---- A memory for each byte of a word.
  for (genvar i = 0; i < 8; ++i) begin : gen_lane
    hmlfc_ram #(.WIDTH(8), .DEPTH(1 << PLACE_BITS)) ram (
        .clk,
        .write(byte_write ? byte_address[2:0] == i : write_beat && wstrb[i]),
        .write_address(byte_write ? byte_address[SIZE_LOG2-1:3] : write_place),
        .write_data(byte_write ? byte_wdata : wdata[8*i+:8]),
        .read(byte_read || read_beat),
        .read_address(byte_read ? byte_address[SIZE_LOG2-1:3] : read_place),
        .read_data(rdata[8*i+:8])
    );
  end
endmodule

`default_nettype wire
