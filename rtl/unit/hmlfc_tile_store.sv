// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The store of one kind of tiles: finds, loads and parses them, keeps the last few, and gives each block what its tile
// has for it: its residual and vector, its motion, or the disparity of its grid block.
//
// A block asks for its tile first (`ask`) and comes back later, with others in between (`in_*`); the time between hides
// the walk through the index. hmlfc_tile_fetch brings the records of what is asked for. Where blocks take one clock, and
// with more than two contexts, two parsers take the residual tiles of even and of odd contexts.
module hmlfc_tile_store #(
    parameter int KIND = hmlfc_pkg::RESIDUAL_TILES,  // or MOTION_TILES, DISPARITY_TILES
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int CLOCKS = 1,  // of a block with residuals; of a vector of a residual tile one, or 2 where this is more
    parameter int DATA_BITS = 128,
    parameter int CONTEXTS = 4,
    parameter int CONTEXT_WORDS = 64,  // words of 64 bits for a record and its skew, a power of two
    localparam bit RESIDUALS = KIND == hmlfc_pkg::RESIDUAL_TILES,
    localparam bit MOTIONS = KIND == hmlfc_pkg::MOTION_TILES,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int INFO_BITS = RESIDUALS ? 9 : MOTIONS ? 17 : 16,
    localparam int SKEW_BITS = $clog2(DATA_BITS),
    localparam int LOAD_BITS = 5 + hmlfc_pkg::TILE_INFO_BITS + TILE_BITS,  // as hmlfc_tile_fetch has them
    localparam int PARSE_BITS = 5 + hmlfc_pkg::TILE_INFO_BITS + 6 + 1 + SKEW_BITS + POSITION_BITS,
    localparam int BEAT_BITS = CONTEXT_BITS + $clog2(CONTEXT_WORDS * 64 / DATA_BITS)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic ask,
    input logic [TILE_BITS-1:0] ask_tile,
    // Residuals: {predictive, rows, columns} of the blocks in the plane; motion: {keyed, height, width} of the tile in
    // samples; disparities: {height, width}.
    input logic [INFO_BITS-1:0] ask_info,
    output logic granted,
    output logic [CONTEXT_BITS-1:0] granted_context,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    input logic [4:0] in_x,  // disparities: place of the grid block in the tile
    input logic [4:0] in_y,
    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,
    output logic out_has_residual,  // 0 but in a store of residuals
    output logic [SAMPLES*VALUE_BITS-1:0] out_residual,

    // Of hmlfc_tile_fetch.
    output logic load_valid,
    input logic load_ready,
    output logic [LOAD_BITS-1:0] load,
    input logic write,
    input logic [BEAT_BITS-1:0] write_beat,
    input logic [DATA_BITS-1:0] data,
    input logic parse_valid,
    output logic parse_ready,
    input logic [PARSE_BITS-1:0] parse
);

  localparam int PARSER_READS = RESIDUALS && CLOCKS == 1 ? 2 : 1;  // read ports of a parser
  localparam int PARSERS = RESIDUALS && CLOCKS == 1 && CONTEXTS > 2 ? 2 : 1;
  localparam int PARSER_LOG2 = PARSERS - 1;
  localparam int PARSED_BITS = CONTEXT_BITS - PARSER_LOG2;  // of a context of one parser
  localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS);
  localparam int PARSER_WORD_BITS = WORD_BITS - PARSER_LOG2;
  localparam int PLACE_BITS = BEAT_BITS - CONTEXT_BITS;  // of a beat in its context
  // Words of a read: a beat's at least, and what a block takes at once, wherever it begins.
  localparam int BEAT_BANKS = DATA_BITS > 128 ? 4 : 2;
  localparam int PART_BANKS = 1 << $clog2((SAMPLES * VALUE_BITS / CLOCKS + 63 + 63) / 64);
  localparam int BANKS = RESIDUALS && PART_BANKS > BEAT_BANKS ? PART_BANKS : BEAT_BANKS;
  localparam int PARSER_BANKS = RESIDUALS ? 4 : BEAT_BANKS;
  localparam int WINDOW_BITS = BANKS * 64;
  localparam int PARSER_BITS = PARSER_BANKS * 64;
  localparam int ENTRY_BITS = 6 + 6 + 4 + 14 + POSITION_BITS;

  logic parse_empty, loaded_valid, loaded_keep, release_valid;
  logic [CONTEXT_BITS-1:0] parse_context, loaded_context, release_context;
  logic [INFO_BITS-1:0] parse_info;
  logic [5:0] parse_error;
  logic [SKEW_BITS-1:0] parse_skew;
  logic [POSITION_BITS-1:0] parse_bits;
  assign parse_context = parse[PARSE_BITS-5+:CONTEXT_BITS];
  assign parse_info = parse[SKEW_BITS+POSITION_BITS+7+:INFO_BITS];
  assign {parse_error, parse_empty, parse_skew, parse_bits} = parse[SKEW_BITS+POSITION_BITS+6:0];

  logic [CONTEXT_BITS-1:0] load_context;
  logic [INFO_BITS-1:0] load_info;
  logic [TILE_BITS-1:0] load_tile;
  logic [CONTEXTS-1:0] ready;
  assign load = {5'(load_context), hmlfc_pkg::TILE_INFO_BITS'(load_info), load_tile};
  hmlfc_tile_contexts #(.CONTEXTS(CONTEXTS), .INFO_BITS(INFO_BITS)) contexts (
      .clk, .rst_n, .flush, .ask, .tile(ask_tile), .info(ask_info), .granted, .context_number(granted_context),
      .load_valid, .load_ready, .load_context, .load_tile, .load_info, .loaded_valid, .loaded_context, .loaded_keep,
      .ready, .release_valid, .release_context
  );

  logic [PARSERS*PARSER_READS-1:0] parser_enable;
  logic [PARSERS*PARSER_READS*PARSER_WORD_BITS-1:0] parser_word;
  logic [PARSERS*PARSER_READS*PARSER_BITS-1:0] parser_window;
  logic blocks_enable;
  logic [WORD_BITS-1:0] blocks_word;
  logic [WINDOW_BITS-1:0] blocks_window;
  for (genvar p = 0; p < PARSERS; p++) begin : g_records
    hmlfc_record_ram #(
        .DATA_BITS(DATA_BITS), .BANKS(PARSER_BANKS), .WORDS(1 << PARSER_WORD_BITS), .READS(PARSER_READS)
    ) records (
        .clk, .write(write && (PARSERS == 1 || write_beat[PLACE_BITS] == 1'(p))),
        .write_beat({write_beat[BEAT_BITS-1:PLACE_BITS+PARSER_LOG2], write_beat[PLACE_BITS-1:0]}), .write_data(data),
        .read_enable(parser_enable[p*PARSER_READS+:PARSER_READS]),
        .read_word(parser_word[p*PARSER_READS*PARSER_WORD_BITS+:PARSER_READS*PARSER_WORD_BITS]),
        .window(parser_window[p*PARSER_READS*PARSER_BITS+:PARSER_READS*PARSER_BITS])
    );
  end
  hmlfc_record_ram #(.DATA_BITS(DATA_BITS), .BANKS(BANKS), .WORDS(CONTEXTS * CONTEXT_WORDS), .READS(1)) blocks_records (
      .clk, .write, .write_beat, .write_data(data), .read_enable(blocks_enable), .read_word(blocks_word),
      .window(blocks_window)
  );

  if (RESIDUALS) begin : g_residuals
    logic [PARSERS-1:0] free, finished, keep, head_write, vector_write, entry_write;
    logic [PARSERS*PARSED_BITS-1:0] parsed_context;
    logic [PARSERS*6-1:0] head_error, vector_number, entry_number;
    logic [PARSERS*64-1:0] head_motion, head_residual;
    logic [PARSERS*18-1:0] vector_data;
    logic [PARSERS*ENTRY_BITS-1:0] entry_data;
    for (genvar p = 0; p < PARSERS; p++) begin : g_parser
      wire mine = PARSERS == 1 || parse_context[0] == 1'(p);
      hmlfc_residual_parser #(
          .BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(CONTEXTS / PARSERS), .CONTEXT_WORDS(CONTEXT_WORDS),
          .WINDOW_BITS(PARSER_BITS), .SKEW_BITS(SKEW_BITS), .READERS(PARSER_READS)
      ) parser (
          .clk, .rst_n, .stream, .parse_valid(parse_valid && mine), .parse_ready(free[p]),
          .parse_context(parse_context[CONTEXT_BITS-1:PARSER_LOG2]), .parse_info, .parse_error, .parse_empty,
          .parse_skew, .parse_bits, .read_enable(parser_enable[p*PARSER_READS+:PARSER_READS]),
          .read_word(parser_word[p*PARSER_READS*PARSER_WORD_BITS+:PARSER_READS*PARSER_WORD_BITS]),
          .window(parser_window[p*PARSER_READS*PARSER_BITS+:PARSER_READS*PARSER_BITS]), .head_write(head_write[p]),
          .head_error(head_error[p*6+:6]), .head_motion(head_motion[p*64+:64]),
          .head_residual(head_residual[p*64+:64]), .vector_write(vector_write[p]),
          .vector_number(vector_number[p*6+:6]), .vector_data(vector_data[p*18+:18]), .entry_write(entry_write[p]),
          .entry_number(entry_number[p*6+:6]), .entry_data(entry_data[p*ENTRY_BITS+:ENTRY_BITS]),
          .loaded_valid(finished[p]), .loaded_ready(p == 0 || !finished[0]),
          .loaded_context(parsed_context[p*PARSED_BITS+:PARSED_BITS]), .loaded_keep(keep[p])
      );
    end
    assign loaded_valid = finished != 0;
    if (PARSERS == 2) begin : g_two
      assign parse_ready = free[parse_context[0]];
      assign loaded_context = finished[0] ? {parsed_context[PARSED_BITS-1:0], 1'b0} :
          {parsed_context[PARSED_BITS+:PARSED_BITS], 1'b1};
      assign loaded_keep = finished[0] ? keep[0] : keep[1];
    end else begin : g_one
      assign {parse_ready, loaded_context, loaded_keep} = {free, parsed_context, keep};
    end

    hmlfc_residual_blocks #(
        .BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .CLOCKS(CLOCKS), .PARSERS(PARSERS), .CONTEXTS(CONTEXTS),
        .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(WINDOW_BITS)
    ) blocks (
        .clk, .rst_n, .stream, .ready, .release_valid, .release_context, .head_write, .vector_write, .entry_write,
        .parsed_context, .head_error, .head_motion, .head_residual, .vector_number, .vector_data, .entry_number,
        .entry_data, .read_enable(blocks_enable), .read_word(blocks_word), .window(blocks_window), .in_valid,
        .in_ready, .in_flow, .out_valid, .out_ready, .out_flow, .out_has_residual, .out_residual
    );
  end else begin : g_no_residual
    assign out_has_residual = 1'b0;
    assign out_residual = '0;
  end

  if (MOTIONS) begin : g_motions
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
        .BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(PARSER_BITS),
        .SKEW_BITS(SKEW_BITS)
    ) parser (
        .clk, .rst_n, .stream, .parse_valid, .parse_ready, .parse_context, .parse_info, .parse_error, .parse_empty,
        .parse_skew, .parse_bits, .read_enable(parser_enable), .read_word(parser_word), .window(parser_window),
        .head_write, .head_error, .head_block_log2, .head_columns, .head_palette_size, .head_level_code, .head_total,
        .head_position, .palette_write, .palette_number, .palette_entry, .loaded_valid, .loaded_context, .loaded_keep
    );

    hmlfc_motion_blocks #(
        .BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(WINDOW_BITS)
    ) blocks (
        .clk, .rst_n, .stream, .ready, .release_valid, .release_context, .parsed_context(loaded_context), .head_write,
        .head_error, .head_block_log2, .head_columns, .head_palette_size, .head_level_code, .head_total, .head_position,
        .palette_write, .palette_number, .palette_entry, .read_enable(blocks_enable), .read_word(blocks_word),
        .window(blocks_window), .in_valid, .in_ready, .in_flow, .out_valid, .out_ready, .out_flow
    );
  end

  if (!RESIDUALS && !MOTIONS) begin : g_disparities
    logic [5:0] head_error;
    logic [12:0] head_least;
    logic [5:0] head_columns;
    logic [5:0] head_level_code;
    logic [13:0] head_total;
    logic [POSITION_BITS-1:0] head_position;
    hmlfc_disparity_parser #(
        .CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(PARSER_BITS), .SKEW_BITS(SKEW_BITS)
    ) parser (
        .clk, .rst_n, .stream, .parse_valid, .parse_ready, .parse_context, .parse_info, .parse_error, .parse_empty,
        .parse_skew, .parse_bits, .read_enable(parser_enable), .read_word(parser_word), .window(parser_window),
        .head_error, .head_least, .head_columns, .head_level_code, .head_total, .head_position, .loaded_valid,
        .loaded_context, .loaded_keep
    );

    hmlfc_disparity_blocks #(.CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(WINDOW_BITS)) blocks (
        .clk, .rst_n, .ready, .release_valid, .release_context, .parsed_context(loaded_context), .head_error,
        .head_least, .head_columns, .head_level_code, .head_total, .head_position, .head_write(loaded_valid),
        .read_enable(blocks_enable), .read_word(blocks_word), .window(blocks_window), .in_valid, .in_ready, .in_flow,
        .in_x, .in_y, .out_valid, .out_ready, .out_flow
    );
  end

endmodule

`default_nettype wire
