// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A queue of DEPTH words.
//
// WIDTH   >= 1, bits of a word
// DEPTH   >= 2; the storage has the next power of two
// BYPASS  with 0 a word that finds the queue empty is offered a clock later, and there is no selection at the output
//
// A word passes when valid and ready are both high; valid does not wait for ready. A word put in is
// offered on the next clock. in_ready is low with DEPTH words inside, also while one is taken.
// count   words inside, [0, DEPTH]
// rst_n   active low, taken synchronously: empties the queue
//
// The storage is read a clock ahead, from the place that will be in front; a word that is put there in the same clock
// is kept beside, or read in the next.
module hmlfc_fifo #(
    parameter int WIDTH = 8,
    parameter int DEPTH = 4,
    parameter bit BYPASS = 1
) (
    input logic clk,
    input logic rst_n,
    input logic in_valid,
    output logic in_ready,
    input logic [WIDTH-1:0] in_data,
    output logic out_valid,
    input logic out_ready,
    output logic [WIDTH-1:0] out_data,
    output logic [$clog2(DEPTH):0] count
);
  localparam integer INDEX_BITS = $clog2(DEPTH);
  localparam [INDEX_BITS:0] ONE = {{INDEX_BITS{1'b0}}, 1'b1};
  localparam WHOLE = DEPTH == 1 << INDEX_BITS;  // the last bit of the count says whether there is room

  logic [WIDTH-1:0]    stored, latest;
  logic [INDEX_BITS:0] written, offered, taken, taken_next;  // words so far, modulo twice the storage
  logic [INDEX_BITS:0] written_before;                       // a clock ago
  logic                put, take, is_latest;                 // the front word is `latest`, else `stored`

  assign count = written - taken;
  assign in_ready = WHOLE ? !count[INDEX_BITS] : count != (INDEX_BITS + 1)'(DEPTH);
  assign offered = BYPASS ? written : written_before;
  assign out_valid = offered != taken;
  assign out_data = BYPASS && is_latest ? latest : stored;
  assign put = in_valid && in_ready;
  assign take = out_valid && out_ready;
  assign taken_next = taken + {{INDEX_BITS{1'b0}}, take};

  hmlfc_ram #(.WIDTH(WIDTH), .DEPTH(1 << INDEX_BITS)) storage (
    .clk, .write(put), .write_address(written[INDEX_BITS-1:0]), .write_data(in_data), .read(1'b1),
    .read_address(taken_next[INDEX_BITS-1:0]), .read_data(stored)
  );

  always_ff @(posedge clk) begin
    if (put) latest <= in_data;
    is_latest <= put && written == taken_next;
    if (!rst_n) begin
      written <= {(INDEX_BITS + 1) {1'b0}};
      written_before <= {(INDEX_BITS + 1) {1'b0}};
      taken <= {(INDEX_BITS + 1) {1'b0}};
    end else begin
      if (put) written <= written + ONE;
      written_before <= written;
      taken <= taken_next;
    end
  end
endmodule

`default_nettype wire
