// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The common part of all tile stores: the contexts that keep tiles, the loaders that bring their records,
// and the memory the records lie in.
//
// A block asks for its tile first (`ask`) and is decoded later, with others in between; the time between
// hides the walk through the index. The store's parser takes a record (`parse_*`), reads it through
// `read_*`, and gives `loaded_*`; then `ready` has the context's bit until another tile replaces it.
// Each block that asked gives its context back (`release_*`).
//
// LOADERS tiles are walked to and fetched at once, each by a client of the read master of its own, and parsed as they
// come. The parser takes parse_* in the clock in which `parse_ready` is high too: before that, a tile that waits may
// give way to another.
module hmlfc_tile_fetch #(
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 4,  // tiles kept, a power of two
    parameter int CONTEXT_WORDS = 64,  // words of 64 bits for a record and its skew, a power of two
    parameter int BANKS = 2,  // words of a window
    parameter int READS = 2,  // read ports
    parameter int LOADERS = 1,
    parameter int INFO_BITS = 16,  // what the parser is told about the tile, as it was asked for
    localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS,
    localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int SKEW_BITS = $clog2(DATA_BITS)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic ask,
    input logic [TILE_BITS-1:0] ask_tile,
    input logic [INFO_BITS-1:0] ask_info,
    output logic granted,
    output logic [CONTEXT_BITS-1:0] granted_context,

    output logic parse_valid,
    input logic parse_ready,
    output logic [CONTEXT_BITS-1:0] parse_context,
    output logic [INFO_BITS-1:0] parse_info,
    output logic [5:0] parse_error,
    output logic parse_empty,
    output logic [SKEW_BITS-1:0] parse_skew,
    output logic [POSITION_BITS-1:0] parse_bits,

    input logic loaded_valid,
    input logic [CONTEXT_BITS-1:0] loaded_context,
    input logic loaded_keep,
    output logic [CONTEXTS-1:0] ready,

    input logic release_valid,
    input logic [CONTEXT_BITS-1:0] release_context,

    input logic [READS-1:0] read_enable,
    input logic [READS*WORD_BITS-1:0] read_word,
    output logic [READS*BANKS*64-1:0] window,

    output logic [LOADERS*READ_REQUEST_BITS-1:0] requests,
    input logic [LOADERS*READ_RESPONSE_BITS-1:0] responses,
    input logic [DATA_BITS-1:0] data
);

  localparam int RECORD_BEATS = CONTEXT_WORDS * 64 / DATA_BITS;

  logic load_valid, load_ready;
  logic [CONTEXT_BITS-1:0] load_context;
  logic [TILE_BITS-1:0] load_tile;
  logic [INFO_BITS-1:0] load_info;
  hmlfc_tile_contexts #(
      .CONTEXTS(CONTEXTS),
      .INFO_BITS(INFO_BITS)
  ) contexts (
      .clk,
      .rst_n,
      .flush,
      .ask,
      .tile(ask_tile),
      .info(ask_info),
      .granted,
      .context_number(granted_context),
      .load_valid,
      .load_ready,
      .load_context,
      .load_tile,
      .load_info,
      .loaded_valid,
      .loaded_context,
      .loaded_keep,
      .ready,
      .release_valid,
      .release_context
  );

  // The first idle loader takes a load, the first that has one gives its record.
  localparam int BEAT_BITS = CONTEXT_BITS + $clog2(RECORD_BEATS);
  localparam int PARSE_BITS = CONTEXT_BITS + INFO_BITS + 6 + 1 + SKEW_BITS + POSITION_BITS;
  logic [LOADERS-1:0] idle, taking, brought, giving, writes;
  logic [LOADERS*BEAT_BITS-1:0] write_beats;
  logic [LOADERS*PARSE_BITS-1:0] parses;
  logic [BEAT_BITS-1:0] write_beat;
  logic [PARSE_BITS-1:0] parse;
  assign taking = idle & ~(idle - 1'b1);
  assign giving = brought & ~(brought - 1'b1);
  assign load_ready = idle != 0;
  assign parse_valid = brought != 0;
  assign {parse_context, parse_info, parse_error, parse_empty, parse_skew, parse_bits} = parse;
  for (genvar i = 0; i < LOADERS; i++) begin : g_loader
    logic [CONTEXT_BITS-1:0] own_context;
    logic [INFO_BITS-1:0] own_info;
    logic [5:0] own_error;
    logic own_empty;
    logic [SKEW_BITS-1:0] own_skew;
    logic [POSITION_BITS-1:0] own_bits;
    assign parses[i*PARSE_BITS+:PARSE_BITS] = {own_context, own_info, own_error, own_empty, own_skew, own_bits};
    hmlfc_tile_loader #(
        .DATA_BITS(DATA_BITS),
        .CONTEXTS(CONTEXTS),
        .RECORD_BEATS(RECORD_BEATS),
        .INFO_BITS(INFO_BITS)
    ) loader (
        .clk,
        .rst_n,
        .stream,
        .flush,
        .load_valid(load_valid && taking[i]),
        .load_ready(idle[i]),
        .load_context,
        .load_tile,
        .load_info,
        .write(writes[i]),
        .write_beat(write_beats[i*BEAT_BITS+:BEAT_BITS]),
        .parse_valid(brought[i]),
        .parse_ready(parse_ready && giving[i]),
        .parse_context(own_context),
        .parse_info(own_info),
        .parse_error(own_error),
        .parse_empty(own_empty),
        .parse_skew(own_skew),
        .parse_bits(own_bits),
        .request(requests[i*READ_REQUEST_BITS+:READ_REQUEST_BITS]),
        .response(responses[i*READ_RESPONSE_BITS+:READ_RESPONSE_BITS]),
        .data
    );
  end
  always_comb begin
    write_beat = '0;
    parse = '0;
    for (int i = 0; i < LOADERS; i++) begin
      write_beat = write_beat | (write_beats[i*BEAT_BITS+:BEAT_BITS] & {BEAT_BITS{writes[i]}});
      parse = parse | (parses[i*PARSE_BITS+:PARSE_BITS] & {PARSE_BITS{giving[i]}});
    end
  end

  hmlfc_record_ram #(
      .DATA_BITS(DATA_BITS),
      .BANKS(BANKS),
      .WORDS(CONTEXTS * CONTEXT_WORDS),
      .READS(READS)
  ) records (
      .clk,
      .write(writes != 0),
      .write_beat,
      .write_data(data),
      .read_enable,
      .read_word,
      .window
  );

endmodule

`default_nettype wire
