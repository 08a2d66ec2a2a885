// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A serial port: 8 data bits, the lowest first, no parity, one stop bit.
//
// CLOCKS_PER_BIT   >= 4, clocks of a bit
//
// `in_valid` is high for one clock for each byte that came; nothing holds it back. A byte is taken from `out_data` in a
// clock with `out_valid` and `out_ready`.
module fpga_serial #(
    parameter int CLOCKS_PER_BIT = 25
) (
    input logic clk,
    input logic rst_n,
    input logic rx,
    output logic tx,
    output logic in_valid,
    output logic [7:0] in_data,
    input logic out_valid,
    output logic out_ready,
    input logic [7:0] out_data
);
  localparam int COUNT_BITS = $clog2(CLOCKS_PER_BIT);
  localparam logic [COUNT_BITS-1:0] WHOLE = COUNT_BITS'(CLOCKS_PER_BIT - 1);
  localparam logic [COUNT_BITS-1:0] HALF = COUNT_BITS'(CLOCKS_PER_BIT / 2 - 1);

  // ---- In: ten bits, each taken in its middle; a start bit that has gone by then was none.
  logic [1:0] pin;
  logic [3:0] in_left;
  logic [COUNT_BITS-1:0] in_count;
  always_ff @(posedge clk) begin
    pin <= {pin[0], rx};
    in_valid <= 1'b0;
    in_count <= in_count - 1'b1;
    if (in_left == 0) begin
      in_count <= HALF;
      if (!pin[1]) in_left <= 4'd10;
    end else if (in_count == 0) begin
      in_count <= WHOLE;
      in_left <= in_left == 4'd10 && pin[1] ? 4'd0 : in_left - 4'd1;
      if (in_left == 4'd1) in_valid <= pin[1];
      else in_data <= {pin[1], in_data[7:1]};
    end
    if (!rst_n) begin
      pin <= 2'b11;
      in_left <= 4'd0;
      in_valid <= 1'b0;
    end
  end

  // ---- Out.
  logic [3:0] out_left;
  logic [8:0] out_bits;
  logic [COUNT_BITS-1:0] out_count;
  assign out_ready = out_left == 0;
  assign tx = out_bits[0];
  always_ff @(posedge clk) begin
    out_count <= out_count - 1'b1;
    if (out_ready) begin
      out_count <= WHOLE;
      if (out_valid) begin
        out_left <= 4'd10;
        out_bits <= {out_data, 1'b0};
      end
    end else if (out_count == 0) begin
      out_count <= WHOLE;
      out_left <= out_left - 4'd1;
      out_bits <= {1'b1, out_bits[8:1]};
    end
    if (!rst_n) begin
      out_left <= 4'd0;
      out_bits <= '1;
    end
  end
endmodule

`default_nettype wire
