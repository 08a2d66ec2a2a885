// Residual tiles: finds, loads and parses them, keeps the last few, and decodes their blocks.
//
// A block asks for its tile first (`ask`) and comes back later, with others in between, to be decoded
// (`in_*`); the time between hides the walk through the index.
module hmlfc_residual_store #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 8,
    parameter int LOADERS = 1,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int INFO_BITS = 9
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic ask,
    input logic [TILE_BITS-1:0] ask_tile,
    input logic [INFO_BITS-1:0] ask_info,  // {predictive, rows, columns} of the blocks in the plane
    output logic granted,
    output logic [CONTEXT_BITS-1:0] granted_context,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,
    output logic out_has_residual,
    output logic [SAMPLES*VALUE_BITS-1:0] out_residual,

    output logic [LOADERS-1:0] request_valid,
    input logic [LOADERS-1:0] request_ready,
    output logic [LOADERS*ADDRESS_BITS-1:0] request_address,
    output logic [LOADERS*10-1:0] request_beats,
    input logic [LOADERS-1:0] data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);

  // The longest record (section 11, bit position in a tile record), with a beat for its skew.
  localparam int MAX_BITS = 64 * (SAMPLES * (MAX_DEPTH + 2) + 23) + 4096 + DATA_BITS;
  localparam int SKEW_BITS = $clog2(DATA_BITS);
  localparam int CONTEXT_WORDS = 1 << $clog2((MAX_BITS + 63) / 64);
  localparam int READS = 3;
  localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS);
  localparam int NEEDED_BANKS = (SAMPLES * VALUE_BITS + 63 + 63) / 64;
  localparam int BANKS = NEEDED_BANKS <= 4 ? 4 : 1 << $clog2(NEEDED_BANKS);
  localparam int WINDOW_BITS = BANKS * 64;
  localparam int ENTRY_BITS = 6 + 6 + 4 + 14 + POSITION_BITS;

  // Read ports: 0 and 1 the parser's, 2 that of the blocks.
  logic parse_valid, parse_ready, parse_empty, loaded_valid, loaded_keep, release_valid;
  logic [CONTEXT_BITS-1:0] parse_context, loaded_context, release_context;
  logic [INFO_BITS-1:0] parse_info;
  logic [5:0] parse_error;
  logic [SKEW_BITS-1:0] parse_skew;
  logic [POSITION_BITS-1:0] parse_bits;
  logic [CONTEXTS-1:0] ready;
  logic [READS-1:0] read_enable;
  logic [READS*WORD_BITS-1:0] read_word;
  logic [READS*WINDOW_BITS-1:0] window;
  hmlfc_tile_fetch #(
      .DATA_BITS(DATA_BITS),
      .CONTEXTS(CONTEXTS),
      .CONTEXT_WORDS(CONTEXT_WORDS),
      .LOADERS(LOADERS),
      .BANKS(BANKS),
      .READS(READS),
      .INFO_BITS(INFO_BITS)
  ) fetch (
      .clk,
      .rst_n,
      .stream,
      .flush,
      .ask,
      .ask_tile,
      .ask_info,
      .granted,
      .granted_context,
      .parse_valid,
      .parse_ready,
      .parse_context,
      .parse_info,
      .parse_error,
      .parse_empty,
      .parse_skew,
      .parse_bits,
      .loaded_valid,
      .loaded_context,
      .loaded_keep,
      .ready,
      .release_valid,
      .release_context,
      .read_enable,
      .read_word,
      .window,
      .request_valid,
      .request_ready,
      .request_address,
      .request_beats,
      .data_valid,
      .data,
      .data_last,
      .data_error
  );

  logic head_write, vector_write, entry_write;
  logic [5:0] head_error, vector_number, entry_number;
  logic [63:0] head_motion, head_residual;
  logic [17:0] vector_data;
  logic [ENTRY_BITS-1:0] entry_data;
  hmlfc_residual_parser #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .CONTEXTS(CONTEXTS),
      .CONTEXT_WORDS(CONTEXT_WORDS),
      .WINDOW_BITS(WINDOW_BITS),
      .SKEW_BITS(SKEW_BITS)
  ) parser (
      .clk,
      .rst_n,
      .stream,
      .parse_valid,
      .parse_ready,
      .parse_context,
      .parse_info,
      .parse_error,
      .parse_empty,
      .parse_skew,
      .parse_bits,
      .read_enable(read_enable[1:0]),
      .read_word(read_word[2*WORD_BITS-1:0]),
      .window(window[2*WINDOW_BITS-1:0]),
      .head_write,
      .head_error,
      .head_motion,
      .head_residual,
      .vector_write,
      .vector_number,
      .vector_data,
      .entry_write,
      .entry_number,
      .entry_data,
      .loaded_valid,
      .loaded_context,
      .loaded_keep
  );

  hmlfc_residual_blocks #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH),
      .CONTEXTS(CONTEXTS),
      .CONTEXT_WORDS(CONTEXT_WORDS),
      .WINDOW_BITS(WINDOW_BITS)
  ) blocks (
      .clk,
      .rst_n,
      .stream,
      .ready,
      .release_valid,
      .release_context,
      .head_write,
      .vector_write,
      .entry_write,
      .parsed_context(loaded_context),
      .head_error,
      .head_motion,
      .head_residual,
      .vector_number,
      .vector_data,
      .entry_number,
      .entry_data,
      .read_enable(read_enable[2]),
      .read_word(read_word[3*WORD_BITS-1:2*WORD_BITS]),
      .window(window[3*WINDOW_BITS-1:2*WINDOW_BITS]),
      .in_valid,
      .in_ready,
      .in_flow,
      .out_valid,
      .out_ready,
      .out_flow,
      .out_has_residual,
      .out_residual
  );

endmodule
