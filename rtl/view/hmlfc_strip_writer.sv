// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// From answers of a request for residuals to lines of memory (64 bytes) with strobes: the strips of a plane of the
// reference area.
//
// `start` takes `view`, which must hold until `done`: every block has been taken. `flush` says that no block will come,
// after a whole strip; `empty`: nothing is held.
// A block with a status is stored as its error. `block_error` is high for one clock for such a block.
module hmlfc_strip_writer #(
    parameter int BLOCK_LOG2 = 2,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = 16 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input hmlfc_pkg::view_t view,
    output logic done,
    input logic flush,
    output logic empty,
    output logic block_error,

    input logic answer_valid,
    output logic answer_ready,
    input logic [BLOCK_BITS-1:0] answer,
    input logic [5:0] answer_status,

    output logic line_valid,
    input logic line_ready,
    output logic [ADDRESS_BITS-7:0] line,
    output logic [511:0] line_data,
    output logic [63:0] line_strobe
);

  // ---- Blocks; the addresses of the strips that have begun.
  logic scan_valid, strip_begins, strip_ends, collect_ready, list_ready, strip_waits;
  logic [ADDRESS_BITS-1:0] strip_address;
  wire wanted = view.residuals && scan_valid && !flush && list_ready;
  wire take = wanted && answer_valid && collect_ready;
  assign done = !scan_valid;
  assign answer_ready = wanted && collect_ready;
  assign block_error = take && answer_status != 0;
  hmlfc_strip_scan #(.BLOCK_LOG2(BLOCK_LOG2)) scan (
      .clk, .rst_n, .start, .view, .valid(scan_valid), .advance(take), .bx(), .by(), .strip_begins, .strip_ends,
      .address(strip_address)
  );
  logic [ADDRESS_BITS-5:0] address;  // of the oldest strip, in units of 16 bytes
  logic word_valid, word_ready, word_last;
  logic [63:0] word;
  hmlfc_fifo #(.WIDTH(ADDRESS_BITS - 4), .DEPTH(4)) addresses (
      .clk, .rst_n, .in_valid(take && strip_begins), .in_ready(list_ready), .in_data(strip_address[ADDRESS_BITS-1:4]),
      .out_valid(strip_waits), .out_ready(word_valid && word_ready && word_last), .out_data(address), .count()
  );

  // ---- Strips, and their words.
  logic collect_empty, strip_valid, strip_ready, pack_empty, read, read_ends;
  logic [3:0] read_quartet;
  logic [63:0] samples;
  logic [4*16-1:0] least, most;
  logic [15:0] errors;
  hmlfc_strip_collect #(.BLOCK_LOG2(BLOCK_LOG2)) collect (
      .clk, .rst_n, .in_valid(take), .in_ready(collect_ready), .in_samples(answer), .in_status(answer_status),
      .in_ends(strip_ends), .out_valid(strip_valid), .out_ready(strip_ready), .out_least(least), .out_most(most),
      .out_errors(errors), .read, .read_quartet, .read_samples(samples), .read_ends, .empty(collect_empty)
  );
  hmlfc_strip_pack pack (
      .clk, .rst_n, .in_valid(strip_valid), .in_ready(strip_ready), .in_least(least), .in_most(most),
      .in_errors(errors), .read, .read_quartet, .samples, .read_ends, .out_valid(word_valid), .out_ready(word_ready),
      .out_word(word), .out_last(word_last), .empty(pack_empty)
  );

  // ---- Words in their line, which leaves with its last word or that of the strip.
  logic [4:0] number;  // of the word in its strip
  wire [ADDRESS_BITS-4:0] place = {address, 1'b0} + (ADDRESS_BITS - 3)'(number);
  assign word_ready = !line_valid && strip_waits;
  wire put = word_valid && word_ready;
  always_ff @(posedge clk) begin
    if (put) line <= place[ADDRESS_BITS-4:3];
    for (int i = 0; i < 8; i++) begin
      if (put && place[2:0] == 3'(i)) {line_data[64*i+:64], line_strobe[8*i+:8]} <= {word, 8'hff};
    end
    if (line_valid && line_ready) line_strobe <= '0;
    if (!rst_n) begin
      line_valid <= 1'b0;
      line_strobe <= '0;
      number <= '0;
    end else begin
      line_valid <= line_valid ? !line_ready : put && (word_last || place[2:0] == 3'd7);
      if (put) number <= word_last ? 5'd0 : number + 5'd1;
    end
  end
  assign empty = collect_empty && pack_empty && !line_valid && !strip_waits;

endmodule

`default_nettype wire
