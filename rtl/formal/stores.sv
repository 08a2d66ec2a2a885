// In the stores of residual tiles, motion tiles and disparities each output of the common part, the parser and the blocks reaches each input that it
// is for, in the same clock, and the store's ports are theirs; whatever they put out. Port 0 of the record memory, in the store of residual tiles port 1
// as well, is the parser's, the last that of the blocks. 64 bits; BLOCK_LOG2 = 2; 2, 4 and 4 contexts; 4, 2 and 2 loaders.
//
// Clauses: none: tile stores (docs/pipeline.md)
// Engine: bmc 1
// Cut: tile_fetch residual_parser residual_blocks motion_parser motion_blocks disparity_parser disparity_blocks
// Parts: 3
// Complete: a store has no logic of its own.
// Fault: hmlfc_residual_store.sv / .window(window[3*WINDOW_BITS-1:2*WINDOW_BITS]) / .window(window[3*WINDOW_BITS-2:2*WINDOW_BITS-1])
// Fault: hmlfc_motion_store.sv / .parsed_context(loaded_context) / .parsed_context(parse_context)
// Fault: hmlfc_disparity_store.sv / .head_write(loaded_valid) / .head_write(loaded_keep)
`include "inside.svh"
module prove_stores #(
  parameter integer PART = 0,
  parameter integer L = PART == 0 ? 4 : 2,                        // loaders
  parameter integer C = PART == 0 ? 1 : 2,                        // bits of a context's number
  parameter integer I = PART == 0 ? 9 : PART == 1 ? 17 : 16,      // of a tile's description
  parameter integer R = PART == 0 ? 3 : 2,                        // read ports
  parameter integer W = PART == 0 ? 10 : PART == 1 ? 8 : 10,      // of a word's address
  parameter integer V = PART == 0 ? 512 : 128                     // of a window
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic ask, input logic [43:0] ask_tile,
  input logic [I-1:0] ask_info, input logic in_valid, input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow, input logic [4:0] in_x, input logic [4:0] in_y,
  input logic out_ready, input logic [L-1:0] request_ready, input logic [L-1:0] data_valid, input logic [63:0] data, input logic data_last,
  input logic data_error
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  logic           granted, in_ready, out_valid, out_has_residual;
  logic [C-1:0]   granted_context;
  logic [F-1:0]   out_flow;
  logic [223:0]   out_residual;
  logic [L-1:0]   request_valid;
  logic [L*40-1:0] request_address;
  logic [L*10-1:0] request_beats;
  generate
    if (PART == 0) begin : g
      hmlfc_residual_store #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .DATA_BITS(64), .CONTEXTS(2), .LOADERS(4)) dut (
        .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .ask(ask), .ask_tile(ask_tile), .ask_info(ask_info), .granted(granted),
        .granted_context(granted_context), .in_valid(in_valid), .in_ready(in_ready), .in_flow(in_flow), .out_valid(out_valid), .out_ready(out_ready),
        .out_flow(out_flow), .out_has_residual(out_has_residual), .out_residual(out_residual), .request_valid(request_valid),
        .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data),
        .data_last(data_last), .data_error(data_error));
      `PORT(751, stream_bits, \dut.blocks.stream )
      `PORT(1, out_has_residual, \dut.blocks.out_has_residual )
      `PORT(224, out_residual, \dut.blocks.out_residual )
      `LINK(1, \dut.parser.head_write , \dut.blocks.head_write )
      `LINK(64, \dut.parser.head_motion , \dut.blocks.head_motion )
      `LINK(64, \dut.parser.head_residual , \dut.blocks.head_residual )
      `LINK(1, \dut.parser.vector_write , \dut.blocks.vector_write )
      `LINK(6, \dut.parser.vector_number , \dut.blocks.vector_number )
      `LINK(18, \dut.parser.vector_data , \dut.blocks.vector_data )
      `LINK(1, \dut.parser.entry_write , \dut.blocks.entry_write )
      `LINK(6, \dut.parser.entry_number , \dut.blocks.entry_number )
      `LINK(48, \dut.parser.entry_data , \dut.blocks.entry_data )
    end
    if (PART == 1) begin : g
      hmlfc_motion_store #(.BLOCK_LOG2(2), .DATA_BITS(64), .CONTEXTS(4), .LOADERS(2)) dut (
        .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .ask(ask), .ask_tile(ask_tile), .ask_info(ask_info), .granted(granted),
        .granted_context(granted_context), .in_valid(in_valid), .in_ready(in_ready), .in_flow(in_flow), .out_valid(out_valid), .out_ready(out_ready),
        .out_flow(out_flow), .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address),
        .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));
      `PORT(751, stream_bits, \dut.blocks.stream )
      `LINK(1, \dut.parser.head_write , \dut.blocks.head_write )
      `LINK(3, \dut.parser.head_block_log2 , \dut.blocks.head_block_log2 )
      `LINK(6, \dut.parser.head_columns , \dut.blocks.head_columns )
      `LINK(6, \dut.parser.head_level_code , \dut.blocks.head_level_code )
      `LINK(14, \dut.parser.head_total , \dut.blocks.head_total )
      `LINK(18, \dut.parser.head_position , \dut.blocks.head_position )
      `LINK(3, \dut.parser.head_palette_size , \dut.blocks.head_palette_size )
      `LINK(1, \dut.parser.palette_write , \dut.blocks.palette_write )
      `LINK(3, \dut.parser.palette_number , \dut.blocks.palette_number )
      `LINK(33, \dut.parser.palette_entry , \dut.blocks.palette_entry )
    end
    if (PART == 2) begin : g
      hmlfc_disparity_store #(.DATA_BITS(64), .CONTEXTS(4), .LOADERS(2)) dut (
        .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .ask(ask), .ask_tile(ask_tile), .ask_info(ask_info), .granted(granted),
        .granted_context(granted_context), .in_valid(in_valid), .in_ready(in_ready), .in_flow(in_flow), .in_x(in_x), .in_y(in_y), .out_valid(out_valid),
        .out_ready(out_ready), .out_flow(out_flow), .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address),
        .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));
      `PORT(5, in_x, \dut.blocks.in_x )
      `PORT(5, in_y, \dut.blocks.in_y )
      `PORT(1, \g.dut.parser.loaded_valid , \dut.blocks.head_write )
      `LINK(6, \dut.parser.head_columns , \dut.blocks.head_columns )
      `LINK(6, \dut.parser.head_level_code , \dut.blocks.head_level_code )
      `LINK(14, \dut.parser.head_total , \dut.blocks.head_total )
      `LINK(18, \dut.parser.head_position , \dut.blocks.head_position )
      `LINK(13, \dut.parser.head_least , \dut.blocks.head_least )
    end
  endgenerate
  `PORT(1, rst_n, \g.dut.fetch.rst_n )
  `PORT(1, rst_n, \g.dut.parser.rst_n )
  `PORT(1, rst_n, \g.dut.blocks.rst_n )
  `PORT(751, stream_bits, \g.dut.fetch.stream )
  `PORT(751, stream_bits, \g.dut.parser.stream )
  `PORT(1, flush, \g.dut.fetch.flush )
  `PORT(1, ask, \g.dut.fetch.ask )
  `PORT(44, ask_tile, \g.dut.fetch.ask_tile )
  `PORT(I, ask_info, \g.dut.fetch.ask_info )
  `PORT(1, granted, \g.dut.fetch.granted )
  `PORT(C, granted_context, \g.dut.fetch.granted_context )
  `PORT(1, in_valid, \g.dut.blocks.in_valid )
  `PORT(1, in_ready, \g.dut.blocks.in_ready )
  `PORT(F, in_flow, \g.dut.blocks.in_flow )
  `PORT(1, out_valid, \g.dut.blocks.out_valid )
  `PORT(1, out_ready, \g.dut.blocks.out_ready )
  `PORT(F, out_flow, \g.dut.blocks.out_flow )
  `PORT(L, request_valid, \g.dut.fetch.request_valid )
  `PORT(L, request_ready, \g.dut.fetch.request_ready )
  `PORT(40*L, request_address, \g.dut.fetch.request_address )
  `PORT(10*L, request_beats, \g.dut.fetch.request_beats )
  `PORT(L, data_valid, \g.dut.fetch.data_valid )
  `PORT(64, data, \g.dut.fetch.data )
  `PORT(1, data_last, \g.dut.fetch.data_last )
  `PORT(1, data_error, \g.dut.fetch.data_error )
  `LINK(1, \g.dut.fetch.parse_valid , \g.dut.parser.parse_valid )
  `LINK(1, \g.dut.fetch.parse_ready , \g.dut.parser.parse_ready )
  `LINK(C, \g.dut.fetch.parse_context , \g.dut.parser.parse_context )
  `LINK(I, \g.dut.fetch.parse_info , \g.dut.parser.parse_info )
  `LINK(6, \g.dut.fetch.parse_error , \g.dut.parser.parse_error )
  `LINK(1, \g.dut.fetch.parse_empty , \g.dut.parser.parse_empty )
  `LINK(6, \g.dut.fetch.parse_skew , \g.dut.parser.parse_skew )
  `LINK(18, \g.dut.fetch.parse_bits , \g.dut.parser.parse_bits )
  `LINK(1, \g.dut.fetch.loaded_valid , \g.dut.parser.loaded_valid )
  `LINK(C, \g.dut.fetch.loaded_context , \g.dut.parser.loaded_context )
  `PORT(C, \g.dut.parser.loaded_context , \g.dut.blocks.parsed_context )
  `LINK(1, \g.dut.fetch.loaded_keep , \g.dut.parser.loaded_keep )
  `LINK((1<<C), \g.dut.fetch.ready , \g.dut.blocks.ready )
  `LINK(1, \g.dut.fetch.release_valid , \g.dut.blocks.release_valid )
  `LINK(C, \g.dut.fetch.release_context , \g.dut.blocks.release_context )
  `LINK(6, \g.dut.parser.head_error , \g.dut.blocks.head_error )
  (* hierconn *) wire [R-1:0] \g.dut.fetch.read_enable ;
  (* hierconn *) wire [R*W-1:0] \g.dut.fetch.read_word ;
  (* hierconn *) wire [R*V-1:0] \g.dut.fetch.window ;
  `PORT(R-1, \g.dut.fetch.read_enable [R-2:0], \g.dut.parser.read_enable )
  `PORT(1, \g.dut.fetch.read_enable [R-1], \g.dut.blocks.read_enable )
  `PORT((R-1)*W, \g.dut.fetch.read_word [(R-1)*W-1:0], \g.dut.parser.read_word )
  `PORT(W, \g.dut.fetch.read_word [R*W-1:(R-1)*W], \g.dut.blocks.read_word )
  `PORT((R-1)*V, \g.dut.fetch.window [(R-1)*V-1:0], \g.dut.parser.window )
  `PORT(V, \g.dut.fetch.window [R*V-1:(R-1)*V], \g.dut.blocks.window )
endmodule
