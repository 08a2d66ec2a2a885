// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// AXI4 memory of soc.sv: bursts of full beats in order, at most 16 waiting, writes of one beat or more; a beat a clock
// each way.
module soc_memory #(
    parameter int BITS = 128,
    parameter int ADDRESS_BITS = 40
) (
    input logic clk,
    input logic rst_n,
    input logic arvalid,
    output logic arready,
    input logic [ADDRESS_BITS-1:0] araddr,
    input logic [7:0] arlen,
    input logic [0:0] arid,
    output logic rvalid,
    input logic rready,
    output logic [BITS-1:0] rdata,
    output logic rlast,
    output logic [0:0] rid,
    input logic awvalid,
    output logic awready,
    input logic [ADDRESS_BITS-1:0] awaddr,
    input logic wvalid,
    output logic wready,
    input logic [BITS-1:0] wdata,
    input logic [BITS/8-1:0] wstrb,
    input logic wlast,
    output logic bvalid,
    input logic bready
);
  localparam logic [ADDRESS_BITS-1:0] BEAT_BYTES = ADDRESS_BITS'(BITS) / 8;

  import "DPI-C" function void soc_read_beat(
      input longint address,
      output bit [127:0] data
  );
  import "DPI-C" function void soc_write_beat(
      input longint address,
      input bit [127:0] data,
      input bit [15:0] strobes
  );

  /* verilator lint_off BLKSEQ */  // queues and calls take effect within their clock
  // ---- Reads.
  typedef struct packed {
    logic [ADDRESS_BITS-1:0] address;
    logic [7:0] more;
    logic [0:0] id;
  } burst_t;
  burst_t bursts[$];
  burst_t burst;
  bit [127:0] beat;
  always @(posedge clk) begin
    if (!rst_n) begin
      bursts.delete();
      rvalid <= 0;
      arready <= 0;
    end else begin
      if (arvalid && arready) bursts.push_back({araddr, arlen, arid});
      if (!rvalid || rready) begin
        rvalid <= bursts.size() != 0;
        if (bursts.size() != 0) begin
          burst = bursts.pop_front();
          soc_read_beat(64'(burst.address), beat);
          rdata <= beat[BITS-1:0];
          rlast <= burst.more == 0;
          rid <= burst.id;
          burst.address += BEAT_BYTES;
          burst.more -= 1;
          if (burst.more != 8'hff) bursts.push_front(burst);
        end
      end
      arready <= bursts.size() < 16;
    end
  end

  // ---- Writes.
  logic [ADDRESS_BITS-1:0] addresses[$];
  logic [ADDRESS_BITS-1:0] place;
  bit in_burst;
  int done;  // bursts without response
  always @(posedge clk) begin
    if (!rst_n) begin
      addresses.delete();
      in_burst = 0;
      done = 0;
      bvalid <= 0;
      awready <= 0;
      wready <= 0;
    end else begin
      if (awvalid && awready) addresses.push_back(awaddr);
      if (wvalid && wready) begin
        if (!in_burst) place = addresses.pop_front();
        soc_write_beat(64'(place), 128'(wdata), 16'(wstrb));
        place += BEAT_BYTES;
        in_burst = !wlast;
        if (wlast) done += 1;
      end
      if (bvalid && bready) done -= 1;
      bvalid <= done != 0;
      awready <= addresses.size() < 16;
      wready <= in_burst || addresses.size() != 0;
    end
  end
endmodule

`default_nettype wire
