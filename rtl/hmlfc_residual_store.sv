// Residual tiles: finds, loads and parses them, keeps the last few, and decodes their blocks.
//
// A block asks for its tile first (`ask`) and comes back later, with others in between, to be decoded
// (`in_*`); the time between hides the walk through the index.
module hmlfc_residual_store #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 8,
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

    output logic request_valid,
    input logic request_ready,
    output logic [ADDRESS_BITS-1:0] request_address,
    output logic [9:0] request_beats,
    input logic data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);

  // The longest record (section 11, bit position in a tile record), with a beat for its skew.
  localparam int MAX_BITS = 64 * (SAMPLES * (MAX_DEPTH + 2) + 23) + 4096 + DATA_BITS;
  localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8);
  localparam int RECORD_BEATS = 1 << $clog2((MAX_BITS + DATA_BITS - 1) / DATA_BITS);
  localparam int CONTEXT_WORDS = RECORD_BEATS * DATA_BITS / 64;
  localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS);
  localparam int NEEDED_BANKS = (SAMPLES * VALUE_BITS + 63 + 63) / 64;
  localparam int BANKS = NEEDED_BANKS <= 4 ? 4 : 1 << $clog2(NEEDED_BANKS);
  localparam int WINDOW_BITS = BANKS * 64;
  localparam int ENTRY_BITS = 6 + 6 + 4 + 14 + POSITION_BITS;

  logic load_valid, load_ready, loaded_valid, loaded_keep, release_valid;
  logic [CONTEXT_BITS-1:0] load_context, loaded_context, release_context;
  logic [TILE_BITS-1:0] load_tile;
  logic [INFO_BITS-1:0] load_info;
  logic [CONTEXTS-1:0] ready;
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

  logic write, parse_valid, parse_ready, parse_empty;
  logic [CONTEXT_BITS+$clog2(RECORD_BEATS)-1:0] write_beat;
  logic [DATA_BITS-1:0] write_data;
  logic [CONTEXT_BITS-1:0] parse_context;
  logic [INFO_BITS-1:0] parse_info;
  logic [5:0] parse_error;
  logic [BEAT_LOG2+2:0] parse_skew;
  logic [POSITION_BITS-1:0] parse_bits;
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

  // Read ports: 0 and 1 the parser's, 2 that of the blocks.
  logic [2:0] read_enable;
  logic [3*WORD_BITS-1:0] read_word;
  logic [3*WINDOW_BITS-1:0] window;
  hmlfc_record_ram #(
      .DATA_BITS(DATA_BITS),
      .BANKS(BANKS),
      .WORDS(CONTEXTS * CONTEXT_WORDS),
      .READS(3)
  ) records (
      .clk,
      .write,
      .write_beat,
      .write_data,
      .read_enable,
      .read_word,
      .window
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
      .SKEW_BITS(BEAT_LOG2 + 3)
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
