// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads of 16 bytes from any byte address for the three steps of an index walk, many at once: one client of
// hmlfc_read_port.
//
// `ask` of a step with its address, when `ask_ready`, begins a read. What a step asked for comes back in its order:
// `valid` with `bytes`, byte i at bits 8i+7:8i, and `error` (a bus error), until `take`. Of two steps that ask, the
// later one goes first. A step has at most DEPTH reads in flight, those included that it has not taken.
module hmlfc_index_reads #(
    parameter int DATA_BITS = 128,
    parameter int DEPTH = 16,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic [2:0] ask,
    output logic [2:0] ask_ready,
    input logic [3*ADDRESS_BITS-1:0] address,

    output logic [2:0] valid,
    input logic [2:0] take,
    output logic [3*128-1:0] bytes,
    output logic [2:0] error,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int BYTES = DATA_BITS / 8;
  localparam int BEAT_LOG2 = $clog2(BYTES);
  localparam int MAX_BEATS = (2 * BYTES + 14) / BYTES;
  localparam int BEAT_BITS = $clog2(MAX_BEATS + 1);

  // Requests: one is held until the port takes it.
  logic [1:0] chosen;
  logic [ADDRESS_BITS-1:0] from;
  wire free = !request.valid || response.ready;
  wire [9:0] span = 10'(from[BEAT_LOG2-1:0]) + 10'(15 + BYTES);
  always_comb begin
    chosen = ask[2] ? 2'd2 : ask[1] ? 2'd1 : 2'd0;
    from = address[0+:ADDRESS_BITS];
    if (ask[1]) from = address[ADDRESS_BITS+:ADDRESS_BITS];
    if (ask[2]) from = address[2*ADDRESS_BITS+:ADDRESS_BITS];
    for (int s = 0; s < 3; s++) ask_ready[s] = free && ask[s] && chosen == 2'(s);
  end
  wire begins = free && ask != 0;
  always_ff @(posedge clk) begin
    if (begins) begin
      request.address <= {from[ADDRESS_BITS-1:BEAT_LOG2], BEAT_LOG2'(0)};
      request.beats <= span >> BEAT_LOG2;
    end
    if (!rst_n) request.valid <= 1'b0;
    else request.valid <= begins || (request.valid && !response.ready);
  end

  // Whose beats come next, and where in the first beat its bytes begin.
  logic [1:0] step, step_1, step_2;
  logic [BEAT_LOG2-1:0] offset, offset_1;
  hmlfc_fifo #(.WIDTH(2 + BEAT_LOG2), .DEPTH(4 * DEPTH)) reads (
      .clk, .rst_n, .in_valid(begins), .in_ready(), .in_data({chosen, from[BEAT_LOG2-1:0]}), .out_valid(),
      .out_ready(response.valid && response.last), .out_data({step, offset}), .count()
  );

  // Its beats; then shifted by words, then by bytes.
  logic [MAX_BEATS*DATA_BITS-1:0] beats;
  logic [BEAT_BITS-1:0] beat;
  logic [151:0] words_2;
  logic [1:0] shift_2;
  logic [2:1] shifts;
  logic failed, error_1, error_2;
  wire now_failed = response.error || (beat != 0 && failed);
  always_ff @(posedge clk) begin
    if (response.valid) begin
      for (int i = 0; i < MAX_BEATS; i++) if (beat == BEAT_BITS'(i)) beats[i*DATA_BITS+:DATA_BITS] <= data;
      beat <= response.last ? '0 : beat + 1'b1;
      failed <= now_failed;
    end
    {step_1, offset_1, error_1} <= {step, offset, now_failed};
    {step_2, shift_2, error_2} <= {step_1, offset_1[1:0], error_1};
    words_2 <= 152'(beats >> {offset_1[BEAT_LOG2-1:2], 5'd0});
    shifts <= {shifts[1], response.valid && response.last};
    if (!rst_n) begin
      beat <= '0;
      shifts <= '0;
    end
  end

  wire [127:0] bytes_2 = 128'(words_2 >> {shift_2, 3'd0});
  for (genvar s = 0; s < 3; s++) begin : g_step
    hmlfc_fifo #(.WIDTH(129), .DEPTH(DEPTH)) answers (
        .clk, .rst_n, .in_valid(shifts[2] && step_2 == 2'(s)), .in_ready(),
        .in_data({error_2, bytes_2}), .out_valid(valid[s]), .out_ready(take[s]),
        .out_data({error[s], bytes[s*128+:128]}), .count()
    );
  end

endmodule

`default_nettype wire
