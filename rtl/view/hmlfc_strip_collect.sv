// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Collects the samples of strips from blocks, four samples a clock, with the least and the greatest of each
// quarter of a strip.
//
// A block with `in_status` has the samples status - 2^15. After the last block of a strip its first sample is repeated
// until the strip has 64. A strip comes out whole: `out_valid` with what is known of it, until `out_ready`; bit i of
// `out_errors` says that its quartet i is of a block with a status. Its samples are read after that: quartet
// `read_quartet`, sample i in bits 16 * i up, is at `read_samples` a clock after `read`, and stays there until the next.
// With `read_ends` the strip is done. Two strips are held.
module hmlfc_strip_collect #(
    parameter int BLOCK_LOG2 = 2,
    localparam int BLOCK_BITS = 16 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,

    input logic in_valid,
    output logic in_ready,
    input logic [BLOCK_BITS-1:0] in_samples,
    input logic [5:0] in_status,
    input logic in_ends,

    output logic out_valid,
    input logic out_ready,
    output logic [4*16-1:0] out_least,
    output logic [4*16-1:0] out_most,
    output logic [15:0] out_errors,
    input logic read,
    input logic [3:0] read_quartet,
    output logic [63:0] read_samples,
    input logic read_ends,
    output logic empty
);

  localparam logic [3:0] LAST_QUARTET = 4'((1 << (2 * BLOCK_LOG2)) / 4 - 1);  // of a block

  // ---- The block, its next four samples in the low bits.
  logic held, ends, error, filling, put;
  logic [5:0] status;
  logic [BLOCK_BITS-1:0] block;
  logic [15:0] first;  // of the strip
  logic [3:0] quartet, place;  // of the block, of the strip
  wire last_of_block = held && quartet == LAST_QUARTET;
  wire last_of_strip = place == 4'd15;
  wire [63:0] four = filling ? {4{first}} : error ? {4{10'b1000000000, status}} : block[63:0];
  assign in_ready = !filling && (!held || (put && last_of_block && !(ends && !last_of_strip)));
  wire take = in_valid && in_ready;
  always_ff @(posedge clk) begin
    if (take) begin
      block <= in_samples;
      status <= in_status;
      error <= in_status != 0;
      ends <= in_ends;
      quartet <= '0;
    end else if (put) begin
      block <= block >> 64;
      quartet <= quartet + 4'd1;
    end
    if (put) begin
      place <= place + 4'd1;
      if (place == 0) first <= four[15:0];
    end
    if (!rst_n) begin
      held <= 1'b0;
      filling <= 1'b0;
      place <= '0;
    end else begin
      held <= take || (held && !(put && last_of_block));
      filling <= (filling || (put && last_of_block && ends)) && !(put && last_of_strip);
    end
  end

  // ---- Least and greatest of four in two clocks, then of the quarter.
  logic [2:1] valid, finishes;
  logic [3:0] place_1, place_2;
  logic signed [15:0] low_0, low_1, high_0, high_1, low_2, high_2;
  logic [15:0] errors;
  logic complete;  // a strip waits to leave
  logic writing, reading;  // the half of the memory
  logic [1:0] used;
  wire leaves = !out_valid || out_ready;
  wire stop = complete && !leaves;
  wire busy = finishes[1] || finishes[2] || complete;  // least and most are those of a whole strip
  assign put = (held || filling) && !busy && !used[writing];
  hmlfc_ram #(.WIDTH(64), .DEPTH(32)) samples (
      .clk, .write(put), .write_address({writing, place}), .write_data(four), .read,
      .read_address({reading, read_quartet}), .read_data(read_samples)
  );
  wire signed [15:0] s0 = four[15:0], s1 = four[31:16], s2 = four[47:32], s3 = four[63:48];
  always_ff @(posedge clk) begin
    if (put) errors <= {four[15:14] == 2'b10, errors[15:1]};
    low_0 <= s0 < s1 ? s0 : s1;
    high_0 <= s0 < s1 ? s1 : s0;
    low_1 <= s2 < s3 ? s2 : s3;
    high_1 <= s2 < s3 ? s3 : s2;
    low_2 <= low_0 < low_1 ? low_0 : low_1;
    high_2 <= high_0 < high_1 ? high_1 : high_0;
    {place_2, place_1} <= {place_1, place};
    if (!rst_n) begin
      valid <= '0;
      finishes <= '0;
      complete <= 1'b0;
      {writing, reading, used} <= '0;
    end else begin
      writing <= writing ^ (put && last_of_strip);
      reading <= reading ^ read_ends;
      for (int i = 0; i < 2; i++) begin
        used[i] <= (used[i] || (put && last_of_strip && writing == 1'(i))) && !(read_ends && reading == 1'(i));
      end
      valid <= {valid[1], put};
      finishes <= {finishes[1], put && last_of_strip};
      complete <= finishes[2] || stop;
    end
  end
  logic [4*16-1:0] least, most;
  wire begins = place_2[1:0] == 2'd0;
  wire signed [15:0] least_2 = least[16*place_2[3:2]+:16], most_2 = most[16*place_2[3:2]+:16];
  always_ff @(posedge clk) begin
    for (int i = 0; i < 4; i++) begin
      if (valid[2] && place_2[3:2] == 2'(i)) begin
        if (begins || low_2 < least_2) least[16*i+:16] <= low_2;
        if (begins || high_2 > most_2) most[16*i+:16] <= high_2;
      end
    end
    if (complete && leaves) begin
      out_errors <= errors;
      out_least <= least;
      out_most <= most;
    end
    if (!rst_n) out_valid <= 1'b0;
    else out_valid <= complete || (out_valid && !out_ready);
  end
  assign empty = !held && !filling && !busy && place == 0 && valid == 0 && !out_valid && used == 0;

endmodule

`default_nettype wire
