// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Brings tile records into a record memory: walks the index and fetches the record.
// `write` puts the beat `data` into the memory, at `write_beat`.
//
// Accepts loads in order; each ends with one `parse_*` beat: the context, the error of the walk or a
// bus error, `empty`, and where the record lies: bit `parse_skew` of the context's part of the memory is
// bit 0 of the record, which has `parse_bits` bits (2^18 - 1 stands for that or more). Of a record longer
// than a context's part only what fits is fetched: no field lies beyond (section 11).
module hmlfc_tile_loader #(
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 4,
    parameter int RECORD_BEATS = 128,  // of a context, a power of two
    parameter int INFO_BITS = 8,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8),
    localparam int BEAT_BITS = $clog2(RECORD_BEATS)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic load_valid,
    output logic load_ready,
    input logic [CONTEXT_BITS-1:0] load_context,
    input logic [TILE_BITS-1:0] load_tile,
    input logic [INFO_BITS-1:0] load_info,

    output logic write,
    output logic [CONTEXT_BITS+BEAT_BITS-1:0] write_beat,

    output logic parse_valid,
    input logic parse_ready,
    output logic [CONTEXT_BITS-1:0] parse_context,
    output logic [INFO_BITS-1:0] parse_info,
    output logic [5:0] parse_error,
    output logic parse_empty,
    output logic [BEAT_LOG2+2:0] parse_skew,
    output logic [POSITION_BITS-1:0] parse_bits,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  typedef enum logic [2:0] {
    IDLE,
    WALK,
    MEASURE,
    ASK,
    FETCH,
    PARSE
  } state_t;
  state_t state;

  logic walk_idle, walk_done, walk_empty;
  logic [5:0] walk_error;
  logic [ADDRESS_BITS-1:0] record_address;
  logic [31:0] record_bytes;
  wire fetching = state == ASK || state == FETCH;
  hmlfc_pkg::read_request_t walk_request;
  hmlfc_pkg::read_response_t walk_response;
  assign walk_response.ready = response.ready && !fetching;
  assign walk_response.valid = response.valid && !fetching;
  assign walk_response.last = response.last;
  assign walk_response.error = response.error;

  hmlfc_tile_walk #(
      .DATA_BITS(DATA_BITS)
  ) walk (
      .clk,
      .rst_n,
      .stream,
      .flush,
      .start(load_valid && load_ready),
      .tile(load_tile),
      .idle(walk_idle),
      .done(walk_done),
      .error(walk_error),
      .empty(walk_empty),
      .record_address,
      .record_bytes,
      .request(walk_request),
      .response(walk_response),
      .data
  );

  localparam int MAX_BYTES = RECORD_BEATS << BEAT_LOG2;
  wire [BEAT_LOG2-1:0] offset = record_address[BEAT_LOG2-1:0];
  wire [32:0] span = 33'(record_bytes) + 33'(offset);  // bytes from the first beat's begin on
  logic [9:0] beats;
  logic [BEAT_BITS-1:0] beat;

  assign load_ready = state == IDLE && walk_idle;
  assign request.valid = fetching ? state == ASK : walk_request.valid;
  assign request.address = fetching ? {record_address[ADDRESS_BITS-1:BEAT_LOG2], BEAT_LOG2'(0)} : walk_request.address;
  assign request.beats = fetching ? beats : walk_request.beats;

  assign write = state == FETCH && response.valid;
  assign write_beat = {parse_context, beat};
  assign parse_valid = state == PARSE;

  always_ff @(posedge clk) begin
    unique case (state)
      IDLE:
      if (load_valid && load_ready) begin
        parse_context <= load_context;
        parse_info <= load_info;
        state <= WALK;
      end
      WALK:
      if (walk_done) begin
        parse_error <= walk_error;
        parse_empty <= walk_empty;
        state <= walk_error != 0 || walk_empty ? PARSE : MEASURE;
      end
      MEASURE: begin
        parse_skew <= {offset, 3'b000};
        parse_bits <= record_bytes[31:POSITION_BITS-3] != 0 ? '1 : POSITION_BITS'(record_bytes << 3);
        beats <= span > 33'(MAX_BYTES) ? 10'(RECORD_BEATS) : 10'((span + 33'((1 << BEAT_LOG2) - 1)) >> BEAT_LOG2);
        beat <= '0;
        state <= ASK;
      end
      ASK: if (response.ready) state <= FETCH;
      FETCH:
      if (response.valid) begin
        beat <= beat + 1'b1;
        if (response.error) parse_error <= 6'(HMLFC_ERROR_BUS_ERROR);
        if (response.last) state <= PARSE;
      end
      default: if (parse_ready) state <= IDLE;  // PARSE
    endcase
    if (!rst_n) state <= IDLE;
  end

endmodule

`default_nettype wire
