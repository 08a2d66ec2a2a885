// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Brings the tile records of three stores: walks the index and fetches each record into the store's memory.
//
// Loads of a store (`load_*`) are taken in its order; of two stores that have one, the one of higher number goes first,
// whose blocks come later. `write` of a store puts the beat `data` into its memory, at `write_beat`, in the low bits:
// the context and its beat. Each load ends with one `parse_*` of its store, those without a record early: the context, the
// error of the walk or a bus error, `empty`, and where the record lies: bit `skew` of the context's part of the memory
// is bit 0 of the record, which has `bits` bits (2^18 - 1 stands for that or more). Of a record longer than a context's
// part only what fits is fetched: no field lies beyond (section 11).
//
// Store s has CONTEXTS[s] contexts, at most 32, and beats for 2^BEATS_LOG2[s] in each. Loads and parses are structures
// of the widths below, one store after the other. Clients of the read master: 0 records, 1 the index.
module hmlfc_tile_fetch #(
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS_0 = 16,
    parameter int CONTEXTS_1 = 4,
    parameter int CONTEXTS_2 = 4,
    parameter int BEATS_LOG2_0 = 7,
    parameter int BEATS_LOG2_1 = 5,
    parameter int BEATS_LOG2_2 = 7,
    localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS,
    localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int INFO_BITS = hmlfc_pkg::TILE_INFO_BITS,
    localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8),
    localparam int LOAD_BITS = 5 + INFO_BITS + TILE_BITS,  // {context, info, tile}
    // {context, info, error, empty, skew, bits}
    localparam int PARSE_BITS = 5 + INFO_BITS + 6 + 1 + BEAT_LOG2 + 3 + POSITION_BITS,
    localparam int BEAT_BITS = 5 + 10  // of a place in a memory
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic [2:0] load_valid,
    output logic [2:0] load_ready,
    input logic [3*LOAD_BITS-1:0] loads,

    output logic [2:0] write,
    output logic [BEAT_BITS-1:0] write_beat,

    output logic [2:0] parse_valid,
    input logic [2:0] parse_ready,
    output logic [3*PARSE_BITS-1:0] parses,

    output logic [2*READ_REQUEST_BITS-1:0] requests,
    input logic [2*READ_RESPONSE_BITS-1:0] responses,
    input logic [DATA_BITS-1:0] data
);

  localparam int WAY_BITS = 2 + 5 + INFO_BITS;  // what a load has on its way: {store, context, info}
  localparam int FETCHES = 16;  // on the way at once, at most

  // A load is held until its walk has begun.
  logic held, walk_ready;
  logic [1:0] store;
  logic [LOAD_BITS-1:0] load;
  always_comb begin
    load_ready = '0;
    for (int s = 0; s < 3; s++) if (load_valid[s]) load_ready = 3'(1 << s);
    if (held) load_ready = '0;
  end
  always_ff @(posedge clk) begin
    for (int s = 0; s < 3; s++) begin
      if (load_ready[s]) begin
        store <= 2'(s);
        load <= loads[s*LOAD_BITS+:LOAD_BITS];
      end
    end
    held <= rst_n && (load_ready != 0 || (held && !walk_ready));
  end

  logic found_valid, found_ready, found_empty;
  logic [WAY_BITS-1:0] found_way;
  logic [5:0] found_error;
  logic [ADDRESS_BITS-1:0] found_address;
  logic [31:0] found_bytes;
  hmlfc_tile_walk #(.DATA_BITS(DATA_BITS), .INFO_BITS(WAY_BITS)) walk (
      .clk, .rst_n, .stream, .flush, .in_valid(held), .in_ready(walk_ready), .in_tile(load[TILE_BITS-1:0]),
      .in_info({store, load[LOAD_BITS-1:TILE_BITS]}), .out_valid(found_valid), .out_ready(found_ready),
      .out_info(found_way), .out_error(found_error), .out_empty(found_empty), .out_address(found_address),
      .out_bytes(found_bytes), .request(requests[READ_REQUEST_BITS+:READ_REQUEST_BITS]),
      .response(responses[READ_RESPONSE_BITS+:READ_RESPONSE_BITS]), .data
  );

  // The beats of the record that was found.
  wire [BEAT_LOG2-1:0] offset = found_address[BEAT_LOG2-1:0];
  wire [32:0] span = 33'(found_bytes) + 33'(offset) + 33'((1 << BEAT_LOG2) - 1);
  wire [32:0] beats = span >> BEAT_LOG2;
  wire [1:0] found_store = found_way[WAY_BITS-1-:2];
  wire [10:0] most = found_store == 2'd0 ? 11'(1 << BEATS_LOG2_0) : found_store == 2'd1 ? 11'(1 << BEATS_LOG2_1) :
      11'(1 << BEATS_LOG2_2);
  wire [POSITION_BITS-1:0] found_bits =
      found_bytes[31:POSITION_BITS-3] != 0 ? '1 : {found_bytes[POSITION_BITS-4:0], 3'd0};
  hmlfc_pkg::read_request_t request;
  hmlfc_pkg::read_response_t response;
  assign requests[0+:READ_REQUEST_BITS] = request;
  assign response = responses[0+:READ_RESPONSE_BITS];
  logic way_ready;
  wire fetches = found_error == 0 && !found_empty;
  wire arrives = response.valid && response.last;  // the record in front, with its last beat
  wire begins = found_valid && fetches && way_ready && (!request.valid || response.ready);
  wire ends = found_valid && !fetches && !arrives;  // nothing is to be fetched
  assign found_ready = begins || ends;
  always_ff @(posedge clk) begin
    if (begins) begin
      request.address <= {found_address[ADDRESS_BITS-1:BEAT_LOG2], BEAT_LOG2'(0)};
      request.beats <= beats > 33'(most) ? 10'(most) : beats[9:0];
    end
    if (!rst_n) request.valid <= 1'b0;
    else request.valid <= begins || (request.valid && !response.ready);
  end

  // Records on their way.
  localparam int ON_WAY_BITS = WAY_BITS + BEAT_LOG2 + 3 + POSITION_BITS;
  logic [ON_WAY_BITS-1:0] way;
  wire [1:0] way_store = way[ON_WAY_BITS-1-:2];
  wire [4:0] way_context = way[ON_WAY_BITS-3-:5];
  hmlfc_fifo #(.WIDTH(ON_WAY_BITS), .DEPTH(FETCHES)) on_way (
      .clk, .rst_n, .in_valid(begins), .in_ready(way_ready), .in_data({found_way, offset, 3'd0, found_bits}),
      .out_valid(), .out_ready(arrives), .out_data(way), .count()
  );

  logic [9:0] beat;
  logic failed;
  wire now_failed = response.error || (beat != 0 && failed);
  always_ff @(posedge clk) begin
    if (response.valid) begin
      beat <= response.last ? '0 : beat + 1'b1;
      failed <= now_failed;
    end
    if (!rst_n) beat <= '0;
  end
  always_comb begin
    for (int s = 0; s < 3; s++) write[s] = response.valid && way_store == 2'(s);
    write_beat = BEAT_BITS'({way_context, beat[BEATS_LOG2_0-1:0]});
    if (way_store == 2'd1) write_beat = BEAT_BITS'({way_context, beat[BEATS_LOG2_1-1:0]});
    if (way_store == 2'd2) write_beat = BEAT_BITS'({way_context, beat[BEATS_LOG2_2-1:0]});
  end

  // A store has no more loads than contexts.
  wire [1:0] end_store = arrives ? way_store : found_store;
  wire [5+INFO_BITS-1:0] end_load = arrives ? way[ON_WAY_BITS-3-:5+INFO_BITS] : found_way[5+INFO_BITS-1:0];
  wire [5:0] end_error = !arrives ? found_error : now_failed ? 6'(HMLFC_ERROR_BUS_ERROR) : 6'd0;
  for (genvar s = 0; s < 3; s++) begin : g_store
    hmlfc_fifo #(.WIDTH(PARSE_BITS), .DEPTH(s == 0 ? CONTEXTS_0 : s == 1 ? CONTEXTS_1 : CONTEXTS_2)) brought (
        .clk, .rst_n, .in_valid((arrives || ends) && end_store == 2'(s)), .in_ready(),
        .in_data({end_load, end_error, !arrives && found_empty, way[BEAT_LOG2+3+POSITION_BITS-1:0]}),
        .out_valid(parse_valid[s]), .out_ready(parse_ready[s]), .out_data(parses[s*PARSE_BITS+:PARSE_BITS]), .count()
    );
  end

endmodule

`default_nettype wire
