// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Fetches strips of the reference area and gives them as lines of samples.
//
// A strip is requested by `ask`, when `ask_ready`, with its address, a multiple of 128, and the place that its lines
// are for. Its first FIRST_BYTES bytes are read at once; how many more there are says its head, and the others are read
// when it has come. Strips leave in the order in which they were requested, `valid` with `place` and `lines` until
// `take`, as hmlfc_strip_unpack makes them, UNPACKERS of which take strips in turn.
module hmlfc_strip_fill #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int DATA_BITS = 128,
    parameter int PLACE_BITS = 8,
    parameter int SLOTS = 32,  // strips in flight, a power of two
    parameter int FIRST_BYTES = 32,  // 32, 64
    parameter int UNPACKERS = 1,  // 1, 2
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

  localparam int HEAD_HALVES = hmlfc_pkg::STRIP_HEAD_HALVES;
  localparam int BEAT_HALVES = DATA_BITS / 16;
  localparam int HALVES_BITS = hmlfc_pkg::STRIP_HALVES_BITS;
  localparam int MAX_BEATS = hmlfc_pkg::STRIP_BYTES * 8 / DATA_BITS;
  localparam int FIRST_BEATS = FIRST_BYTES * 8 / DATA_BITS;
  localparam int BEAT_BITS = $clog2(MAX_BEATS);
  localparam int SLOT_BITS = $clog2(SLOTS);
  localparam int LINES_BITS = $bits(lines);
  localparam int TURN_BITS = UNPACKERS == 2 ? 1 : 0;  // of a slot: whose it is

  // Slots: a ring of strips in flight.
  logic [SLOT_BITS-1:0] ask_slot;
  logic [UNPACKERS-1:0] full, unpacked;
  logic [ADDRESS_BITS-1:7] addresses[SLOTS];
  logic [HALVES_BITS-1:0] totals[SLOTS];

  // Reads to ask for: what is left of strips whose head has come, before the begins of others.
  logic first_valid, first_ready, more_valid;
  logic [SLOT_BITS-1:0] first_slot, more_slot, burst_slot;
  logic [ADDRESS_BITS-1:0] first_address;
  logic more_push, burst_valid, burst_more;
  wire request_more = more_valid;
  wire [SLOT_BITS-1:0] request_slot = request_more ? more_slot : first_slot;
  wire [9:0] request_beats = (10'(totals[more_slot]) + 10'(BEAT_HALVES - 1)) >> $clog2(BEAT_HALVES);
  assign request.valid = more_valid || first_valid;
  assign first_ready = response.ready && !request_more;
  assign request.address = request_more ? {addresses[more_slot], 7'(FIRST_BYTES)} : first_address;
  assign request.beats = request_more ? request_beats - 10'(FIRST_BEATS) : 10'(FIRST_BEATS);
  hmlfc_fifo #(.WIDTH(SLOT_BITS + ADDRESS_BITS), .DEPTH(SLOTS)) firsts (
      .clk, .rst_n, .in_valid(ask), .in_ready(), .in_data({ask_slot, ask_address}), .out_valid(first_valid),
      .out_ready(first_ready), .out_data({first_slot, first_address}), .count()
  );
  hmlfc_fifo #(.WIDTH(SLOT_BITS), .DEPTH(SLOTS)) mores (
      .clk, .rst_n, .in_valid(more_push), .in_ready(), .in_data(burst_slot), .out_valid(more_valid),
      .out_ready(response.ready && request_more), .out_data(more_slot), .count()
  );
  // Whose data come next.
  hmlfc_fifo #(.WIDTH(SLOT_BITS + 1), .DEPTH(2 * SLOTS)) bursts (
      .clk, .rst_n, .in_valid(request.valid && response.ready), .in_ready(), .in_data({request_more, request_slot}),
      .out_valid(burst_valid), .out_ready(response.valid && response.last), .out_data({burst_more, burst_slot}),
      .count()
  );

  // Data. All widths are in the first beat.
  logic [BEAT_BITS-1:0] beat;
  logic [HALVES_BITS-1:0] head_total, total;
  logic burst_failed;
  wire [BEAT_BITS-1:0] at = beat + (burst_more ? BEAT_BITS'(FIRST_BEATS) : BEAT_BITS'(0));
  always_comb begin
    head_total = HALVES_BITS'(HEAD_HALVES);
    for (int q = 0; q < 4; q++) head_total = head_total + HALVES_BITS'(data[20*q+:4]) - HALVES_BITS'(&data[20*q+:4]);
  end
  wire [HALVES_BITS-1:0] now_total = beat == 0 ? head_total : total;
  wire now_failed = response.error || (beat != 0 && burst_failed);
  wire ends = response.valid && burst_valid && response.last;
  assign more_push = ends && !burst_more && !now_failed && now_total > HALVES_BITS'(FIRST_BYTES / 2);
  always_ff @(posedge clk) begin
    if (response.valid) begin
      beat <= response.last ? '0 : beat + 1'b1;
      total <= now_total;
      burst_failed <= now_failed;
    end
    if (ask) begin
      ask_slot <= ask_slot + 1'b1;
      addresses[ask_slot] <= ask_address[ADDRESS_BITS-1:7];
    end
    if (ends && !burst_more) totals[burst_slot] <= now_total;
    if (!rst_n) begin
      ask_slot <= '0;
      beat <= '0;
    end
  end

  // Unpackers, and whose turn it is to give a strip.
  logic turn;
  logic [UNPACKERS*PLACE_BITS-1:0] places;
  logic [UNPACKERS*LINES_BITS-1:0] strips;
  for (genvar u = 0; u < UNPACKERS; u++) begin : g_unpack
    wire asked_here = UNPACKERS == 1 || ask_slot[0] == 1'(u);
    wire here = UNPACKERS == 1 || burst_slot[0] == 1'(u);
    hmlfc_strip_unpack #(
        .BLOCK_LOG2(BLOCK_LOG2), .SAMPLE_BITS(SAMPLE_BITS), .DATA_BITS(DATA_BITS), .PLACE_BITS(PLACE_BITS),
        .SLOTS(SLOTS / UNPACKERS)
    ) unpack (
        .clk, .rst_n, .ask(ask && asked_here), .ask_place, .full(full[u]), .write(response.valid && here),
        .ends(ends && !more_push && here), .failed(now_failed), .slot(burst_slot[SLOT_BITS-1:TURN_BITS]), .beat(at),
        .data, .valid(unpacked[u]), .place(places[u*PLACE_BITS+:PLACE_BITS]), .lines(strips[u*LINES_BITS+:LINES_BITS]),
        .take(take && turn == 1'(u))
    );
  end
  always_ff @(posedge clk) turn <= rst_n && UNPACKERS == 2 && (turn ^ take);
  if (UNPACKERS == 2) begin : g_two
    assign ask_ready = !full[ask_slot[0]];
    assign valid = unpacked[turn];
    assign {place, lines} = turn ? {places[PLACE_BITS+:PLACE_BITS], strips[LINES_BITS+:LINES_BITS]} :
        {places[0+:PLACE_BITS], strips[0+:LINES_BITS]};
  end else begin : g_one
    assign ask_ready = !full;
    assign {valid, place, lines} = {unpacked, places, strips};
  end

endmodule

`default_nettype wire
