// The common part of all tile stores: the contexts that keep tiles, the loader that brings their records,
// and the memory the records lie in.
//
// A block asks for its tile first (`ask`) and is decoded later, with others in between; the time between
// hides the walk through the index. The store's parser takes a record (`parse_*`), reads it through
// `read_*`, and gives `loaded_*`; then `ready` has the context's bit until another tile replaces it.
// Each block that asked gives its context back (`release_*`).
module hmlfc_tile_fetch #(
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 4,        // tiles kept, a power of two
    parameter int CONTEXT_WORDS = 64,  // words of 64 bits for a record and its skew, a power of two
    parameter int BANKS = 2,           // words of a window
    parameter int READS = 2,           // read ports
    parameter int INFO_BITS = 16,      // what the parser is told about the tile, as it was asked for
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
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

    output logic request_valid,
    input logic request_ready,
    output logic [ADDRESS_BITS-1:0] request_address,
    output logic [9:0] request_beats,
    input logic data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
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

  logic write;
  logic [CONTEXT_BITS+$clog2(RECORD_BEATS)-1:0] write_beat;
  logic [DATA_BITS-1:0] write_data;
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
      .load_valid,
      .load_ready,
      .load_context,
      .load_tile,
      .load_info,
      .write,
      .write_beat,
      .write_data,
      .parse_valid,
      .parse_ready,
      .parse_context,
      .parse_info,
      .parse_error,
      .parse_empty,
      .parse_skew,
      .parse_bits,
      .request_valid,
      .request_ready,
      .request_address,
      .request_beats,
      .data_valid,
      .data,
      .data_last,
      .data_error
  );

  hmlfc_record_ram #(
      .DATA_BITS(DATA_BITS),
      .BANKS(BANKS),
      .WORDS(CONTEXTS * CONTEXT_WORDS),
      .READS(READS)
  ) records (
      .clk,
      .write,
      .write_beat,
      .write_data,
      .read_enable,
      .read_word,
      .window
  );

endmodule
