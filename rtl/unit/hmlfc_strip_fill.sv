// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Fetches strips of the reference area and unpacks them into lines of samples.
//
// A strip is requested by `ask`, when `ask_ready`, with its address and the place that its lines are for. Its first
// beats are read at once; how many more there are says its head, and the others are read when it has come. Strips leave
// in the order in which they were requested: `valid` with `place` and `lines` until `take`. A line is {error, samples},
// the samples of one block SAMPLE_BITS wide in two's complement, row by row; `error` is the number that an undecodable
// block carries, or bus_error.
module hmlfc_strip_fill #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int DATA_BITS = 128,
    parameter int PLACE_BITS = 8,
    parameter int SLOTS = 32,  // strips in flight, a power of two
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int LINES = 64 / SAMPLES,
    localparam int LINE_BITS = 6 + SAMPLES * SAMPLE_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic ask,
    output logic ask_ready,
    input logic [ADDRESS_BITS-1:0] ask_address,
    input logic [PLACE_BITS-1:0] ask_place,

    output logic valid,
    output logic [PLACE_BITS-1:0] place,
    output logic [LINES*LINE_BITS-1:0] lines,
    input logic take,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int HEAD_BITS = 20;  // width and base
  localparam int RAW = 15;        // the width that stands for samples of 16 bits without base
  localparam int MAX_BITS = HEAD_BITS + 64 * 16;
  localparam int MAX_BEATS = (MAX_BITS + DATA_BITS - 1) / DATA_BITS;
  localparam int FIRST_BYTES = 32;
  localparam int FIRST_BEATS = FIRST_BYTES * 8 / DATA_BITS;
  localparam int BEAT_BITS = $clog2(MAX_BEATS + 1);
  localparam int SLOT_BITS = $clog2(SLOTS);

  // Slots: a ring of strips in flight.
  logic [SLOT_BITS:0] asked, taken;  // count strips; the low bits are the slot
  wire [SLOT_BITS-1:0] ask_slot = asked[SLOT_BITS-1:0];
  logic [SLOTS-1:0] complete, failed;
  logic [ADDRESS_BITS-1:0] addresses[SLOTS];  // behind the first beats
  logic [BEAT_BITS-1:0] totals[SLOTS];

  // Reads to ask for: what is left of strips whose head has come, before the begins of others.
  logic first_valid, first_ready, more_valid;
  logic [SLOT_BITS-1:0] first_slot, more_slot, burst_slot;
  logic [ADDRESS_BITS-1:0] first_address;
  logic more_push, burst_valid, burst_more;
  wire request_more = more_valid;
  wire [SLOT_BITS-1:0] request_slot = request_more ? more_slot : first_slot;
  wire [BEAT_BITS-1:0] request_total = totals[more_slot];
  assign ask_ready = asked - taken != (SLOT_BITS + 1)'(SLOTS);
  assign request.valid = more_valid || first_valid;
  assign first_ready = response.ready && !request_more;
  assign request.address = request_more ? addresses[more_slot] : first_address;
  assign request.beats = request_more ? 10'(request_total) - 10'(FIRST_BEATS) : 10'(FIRST_BEATS);
  hmlfc_fifo #(
      .WIDTH(SLOT_BITS + ADDRESS_BITS),
      .DEPTH(SLOTS)
  ) firsts (
      .clk,
      .rst_n,
      .in_valid(ask),
      .in_ready(),
      .in_data({ask_slot, ask_address}),
      .out_valid(first_valid),
      .out_ready(first_ready),
      .out_data({first_slot, first_address}),
      .count()
  );
  hmlfc_fifo #(
      .WIDTH(SLOT_BITS),
      .DEPTH(SLOTS)
  ) mores (
      .clk,
      .rst_n,
      .in_valid(more_push),
      .in_ready(),
      .in_data(burst_slot),
      .out_valid(more_valid),
      .out_ready(response.ready && request_more),
      .out_data(more_slot),
      .count()
  );
  // Whose data come next.
  hmlfc_fifo #(
      .WIDTH(SLOT_BITS + 1),
      .DEPTH(2 * SLOTS)
  ) bursts (
      .clk,
      .rst_n,
      .in_valid(request.valid && response.ready),
      .in_ready(),
      .in_data({request_more, request_slot}),
      .out_valid(burst_valid),
      .out_ready(response.valid && response.last),
      .out_data({burst_more, burst_slot}),
      .count()
  );

  // The sum has a clock of its own; the first beats come later.
  logic [SLOT_BITS-1:0] sum_slot;
  logic [ADDRESS_BITS-1:0] sum_address;
  always_ff @(posedge clk) begin
    if (ask) begin
      sum_slot <= ask_slot;
      sum_address <= ask_address;
    end
    addresses[sum_slot] <= sum_address + ADDRESS_BITS'(FIRST_BYTES);
  end

  // Data. The head is in the first beat.
  logic [BEAT_BITS-1:0] beat, total;
  logic burst_failed;
  wire [BEAT_BITS-1:0] at = beat + (burst_more ? BEAT_BITS'(FIRST_BEATS) : BEAT_BITS'(0));
  wire [10:0] strip_bits = 11'(HEAD_BITS) + (data[3:0] == 4'(RAW) ? 11'd1024 : {1'b0, data[3:0], 6'd0});
  wire [BEAT_BITS-1:0] head_total = BEAT_BITS'((strip_bits + 11'(DATA_BITS - 1)) / 11'(DATA_BITS));
  wire [BEAT_BITS-1:0] now_total = beat == 0 ? head_total : total;
  wire now_failed = response.error || (beat != 0 && burst_failed);
  wire ends = response.valid && burst_valid && response.last;
  assign more_push = ends && !burst_more && !now_failed && now_total > BEAT_BITS'(FIRST_BEATS);
  always_ff @(posedge clk) begin
    if (response.valid) begin
      beat <= response.last ? '0 : beat + 1'b1;
      total <= now_total;
      burst_failed <= now_failed;
    end
    if (ask) begin
      asked <= asked + 1'b1;
      complete[ask_slot] <= 1'b0;
      failed[ask_slot] <= 1'b0;
    end
    if (ends) begin
      if (!burst_more) totals[burst_slot] <= now_total;
      complete[burst_slot] <= !more_push;
      failed[burst_slot] <= now_failed;
    end
    if (!rst_n) begin
      asked <= '0;
      beat <= '0;
    end
  end

  // Assembly of the oldest strip when it is complete, one beat a clock: a beat is read, then put into the strip; then
  // the strip is offered.
  logic [MAX_BEATS*DATA_BITS-1:0] assembly, strip;
  logic [DATA_BITS-1:0] word;
  logic [BEAT_BITS-1:0] number, word_number;
  logic word_valid, word_last, word_failed, assembled, assembly_failed, strip_failed;
  logic [PLACE_BITS-1:0] word_place, assembly_place;
  wire [SLOT_BITS-1:0] slot = taken[SLOT_BITS-1:0];
  wire there = asked != taken && complete[slot];
  wire last = failed[slot] || number + 1'b1 == totals[slot];
  wire move = assembled && (!valid || take);
  wire put = word_valid && (!assembled || move);
  wire read = there && (!word_valid || put);
  hmlfc_ram #(
      .WIDTH(DATA_BITS),
      .DEPTH(SLOTS << BEAT_BITS)
  ) beats (
      .clk,
      .write(response.valid),
      .write_address({burst_slot, at}),
      .write_data(data),
      .read,
      .read_address({slot, number}),
      .read_data(word)
  );
  hmlfc_ram #(
      .WIDTH(PLACE_BITS),
      .DEPTH(SLOTS)
  ) places (
      .clk,
      .write(ask),
      .write_address(ask_slot),
      .write_data(ask_place),
      .read,
      .read_address(slot),
      .read_data(word_place)
  );
  always_ff @(posedge clk) begin
    if (read) begin
      word_number <= number;
      word_last <= last;
      word_failed <= failed[slot];
      number <= last ? '0 : number + 1'b1;
      if (last) taken <= taken + 1'b1;
    end
    if (put) begin
      for (int n = 0; n < MAX_BEATS; n++) if (word_number == BEAT_BITS'(n)) assembly[n*DATA_BITS+:DATA_BITS] <= word;
      assembly_failed <= word_failed;
      assembly_place <= word_place;
    end
    if (move) begin
      strip <= assembly;
      strip_failed <= assembly_failed;
      place <= assembly_place;
    end
    if (!rst_n) begin
      number <= '0;
      taken <= '0;
      word_valid <= 1'b0;
      assembled <= 1'b0;
      valid <= 1'b0;
    end else begin
      word_valid <= read || (word_valid && !put);
      assembled <= (put && word_last) || (assembled && !move);
      valid <= move || (valid && !take);
    end
  end

  // Samples: base + a field of `width` bits, or 16 bits of their own.
  wire [3:0] width = strip[3:0];
  wire signed [15:0] base = strip[19:4];
  logic [64*16-1:0] samples;
  always_comb begin
    for (int s = 0; s < 64; s++) begin
      logic [15:0] field;
      field = '0;
      for (int w = 1; w <= SAMPLE_BITS; w++) begin
        field = field | (strip[HEAD_BITS+w*s+:16] & 16'((1 << w) - 1) & {16{width == 4'(w)}});
      end
      samples[16*s+:16] = width == 4'(RAW) ? strip[HEAD_BITS+16*s+:16] : 16'(base) + field;
    end
    for (int l = 0; l < LINES; l++) begin
      for (int s = 0; s < SAMPLES; s++) begin
        lines[l*LINE_BITS+s*SAMPLE_BITS+:SAMPLE_BITS] = samples[16*(l*SAMPLES+s)+:SAMPLE_BITS];
      end
      lines[l*LINE_BITS+SAMPLES*SAMPLE_BITS+:6] =
          strip_failed ? HMLFC_ERROR_BUS_ERROR :
          width == 4'(RAW) && samples[16*l*SAMPLES+5+:11] == 11'h400 ? {1'b0, samples[16*l*SAMPLES+:5]} : 6'd0;
    end
  end

endmodule

`default_nettype wire
