// Motion tiles of predictive images: finds, loads and parses them, keeps the last few, and gives each
// block its motion.
//
// A block asks for its tile first (`ask`) and comes back later (`in_*`); the time between hides the walk
// through the index.
module hmlfc_motion_store #(
    parameter int BLOCK_LOG2 = 2,
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 4,
    parameter int LOADERS = 1,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int INFO_BITS = 17
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic ask,
    input logic [TILE_BITS-1:0] ask_tile,
    input logic [INFO_BITS-1:0] ask_info,  // {keyed, height, width} of the tile in samples
    output logic granted,
    output logic [CONTEXT_BITS-1:0] granted_context,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,

    output logic [LOADERS-1:0] request_valid,
    input logic [LOADERS-1:0] request_ready,
    output logic [LOADERS*ADDRESS_BITS-1:0] request_address,
    output logic [LOADERS*10-1:0] request_beats,
    input logic [LOADERS-1:0] data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);

  localparam int MAX_BITS = 9 + 8 * 32 + 3 * 1024 + DATA_BITS;  // of a record and its skew
  localparam int SKEW_BITS = $clog2(DATA_BITS);
  localparam int CONTEXT_WORDS = 1 << $clog2((MAX_BITS + 63) / 64);
  localparam int READS = 2;
  localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS);
  localparam int BANKS = 2;
  localparam int WINDOW_BITS = BANKS * 64;

  // Read ports: 0 the parser's, 1 that of the blocks.
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

  logic head_write;
  logic [5:0] head_error;
  logic [2:0] head_block_log2;
  logic [5:0] head_columns;
  logic [2:0] head_palette_size;
  logic [5:0] head_level_code;
  logic [13:0] head_total;
  logic [POSITION_BITS-1:0] head_position;
  logic palette_write;
  logic [2:0] palette_number;
  hmlfc_pkg::motion_t palette_entry;
  hmlfc_motion_parser #(
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
      .read_enable(read_enable[0]),
      .read_word(read_word[WORD_BITS-1:0]),
      .window(window[WINDOW_BITS-1:0]),
      .head_write,
      .head_error,
      .head_block_log2,
      .head_columns,
      .head_palette_size,
      .head_level_code,
      .head_total,
      .head_position,
      .palette_write,
      .palette_number,
      .palette_entry,
      .loaded_valid,
      .loaded_context,
      .loaded_keep
  );

  hmlfc_motion_blocks #(
      .BLOCK_LOG2(BLOCK_LOG2),
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
      .parsed_context(loaded_context),
      .head_write,
      .head_error,
      .head_block_log2,
      .head_columns,
      .head_palette_size,
      .head_level_code,
      .head_total,
      .head_position,
      .palette_write,
      .palette_number,
      .palette_entry,
      .read_enable(read_enable[1]),
      .read_word(read_word[2*WORD_BITS-1:WORD_BITS]),
      .window(window[2*WINDOW_BITS-1:WINDOW_BITS]),
      .in_valid,
      .in_ready,
      .in_flow,
      .out_valid,
      .out_ready,
      .out_flow
  );

endmodule
