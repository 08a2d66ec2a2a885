// The parts of a tile store in common: the first idle loader takes what the contexts have to load, the first that has brought a record gives it
// to the parser, and each signal reaches its place in the same clock, whatever contexts, loaders and record memory put out. At most one loader writes.
//
// Clauses: none: tile stores (docs/pipeline.md)
// Engine: bmc 1
// Cut: tile_contexts record_ram
// Complete: it has no register of its own.
// Fault: hmlfc_tile_fetch.sv / giving = brought & ~(brought - 1'b1) / giving = brought
// Fault: hmlfc_tile_fetch.sv / .load_valid(load_valid && taking[i]) / .load_valid(load_valid && idle[i])
// Fault: hmlfc_tile_fetch.sv / .data_valid(data_valid[i]) / .data_valid(data_valid[0])
// Fault: hmlfc_tile_fetch.sv / .write(writes != 0) / .write(writes[0])
`include "inside.svh"
// In the place of a loader.
module hmlfc_tile_loader #(parameter integer DATA_BITS = 128, parameter integer CONTEXTS = 4, parameter integer RECORD_BEATS = 128,
  parameter integer INFO_BITS = 8, localparam integer C = $clog2(CONTEXTS), localparam integer BEAT = C + $clog2(RECORD_BEATS)
) (
  input logic clk, input logic rst_n, input logic [750:0] stream, input logic flush, input logic load_valid, output logic load_ready,
  input logic [C-1:0] load_context, input logic [43:0] load_tile, input logic [INFO_BITS-1:0] load_info, output logic write,
  output logic [BEAT-1:0] write_beat, output logic parse_valid, input logic parse_ready, output logic [C-1:0] parse_context,
  output logic [INFO_BITS-1:0] parse_info, output logic [5:0] parse_error, output logic parse_empty, output logic [5:0] parse_skew,
  output logic [17:0] parse_bits, output logic request_valid, input logic request_ready, output logic [39:0] request_address,
  output logic [9:0] request_beats, input logic data_valid, input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  (* anyseq *) logic [BEAT+C+INFO_BITS+84:0] any;
  wire [DATA_BITS+C+INFO_BITS+802:0] given = {load_valid, parse_ready, rst_n, stream, flush, load_context, load_tile, load_info, request_ready,
    data_valid, data, data_last, data_error};
  assign {load_ready, parse_valid, write, write_beat, parse_context, parse_info, parse_error, parse_empty, parse_skew, parse_bits, request_valid,
    request_address, request_beats} = any;
endmodule

module prove_tile_fetch #(
  parameter integer DATA_BITS = 64,
  parameter integer CONTEXTS = 4,
  parameter integer CONTEXT_WORDS = 64,
  parameter integer BANKS = 2,
  parameter integer READS = 2,
  parameter integer LOADERS = 2,
  parameter integer INFO_BITS = 17,
  localparam integer C = $clog2(CONTEXTS),
  localparam integer T = hmlfc_pkg::TILE_BITS,
  localparam integer WORD = $clog2(CONTEXTS * CONTEXT_WORDS),
  localparam integer BEAT = C + $clog2(CONTEXT_WORDS * 64 / DATA_BITS),
  localparam integer P = C + INFO_BITS + 31  // what the parser gets
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic ask, input logic [T-1:0] ask_tile,
  input logic [INFO_BITS-1:0] ask_info, input logic parse_ready, input logic loaded_valid, input logic [C-1:0] loaded_context, input logic loaded_keep,
  input logic release_valid, input logic [C-1:0] release_context, input logic [READS-1:0] read_enable, input logic [READS*WORD-1:0] read_word,
  input logic [LOADERS-1:0] request_ready, input logic [LOADERS-1:0] data_valid, input logic [DATA_BITS-1:0] data, input logic data_last,
  input logic data_error
);
  logic         granted, parse_valid, parse_empty;
  logic [C-1:0] granted_context, parse_context;
  logic [INFO_BITS-1:0] parse_info;
  logic [5:0]   parse_error, parse_skew;
  logic [17:0]  parse_bits;
  logic [CONTEXTS-1:0] ready;
  logic [READS*BANKS*64-1:0] window;
  logic [LOADERS-1:0] request_valid, idle, brought, writes;
  logic [LOADERS*40-1:0] request_address;
  logic [LOADERS*10-1:0] request_beats;
  hmlfc_tile_fetch #(.DATA_BITS(DATA_BITS), .CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .BANKS(BANKS), .READS(READS), .LOADERS(LOADERS), .INFO_BITS(INFO_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .ask(ask), .ask_tile(ask_tile), .ask_info(ask_info), .granted(granted),
    .granted_context(granted_context), .parse_valid(parse_valid), .parse_ready(parse_ready), .parse_context(parse_context), .parse_info(parse_info),
    .parse_error(parse_error), .parse_empty(parse_empty), .parse_skew(parse_skew), .parse_bits(parse_bits), .loaded_valid(loaded_valid),
    .loaded_context(loaded_context), .loaded_keep(loaded_keep), .ready(ready), .release_valid(release_valid), .release_context(release_context),
    .read_enable(read_enable), .read_word(read_word), .window(window), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last),
    .data_error(data_error));
  `PORT(1, rst_n, \dut.contexts.rst_n )
  `PORT(1, flush, \dut.contexts.flush )
  `PORT(1, ask, \dut.contexts.ask )
  `PORT(T, ask_tile, \dut.contexts.tile )
  `PORT(INFO_BITS, ask_info, \dut.contexts.info )
  `PORT(1, granted, \dut.contexts.granted )
  `PORT(C, granted_context, \dut.contexts.context_number )
  `SEEN(1, \dut.contexts.load_valid )
  `PORT(1, (idle != 0), \dut.contexts.load_ready )
  `SEEN(C, \dut.contexts.load_context )
  `SEEN(T, \dut.contexts.load_tile )
  `SEEN(INFO_BITS, \dut.contexts.load_info )
  `PORT(1, loaded_valid, \dut.contexts.loaded_valid )
  `PORT(C, loaded_context, \dut.contexts.loaded_context )
  `PORT(1, loaded_keep, \dut.contexts.loaded_keep )
  `PORT(CONTEXTS, ready, \dut.contexts.ready )
  `PORT(1, release_valid, \dut.contexts.release_valid )
  `PORT(C, release_context, \dut.contexts.release_context )
  `PORT(1, (writes != 0), \dut.records.write )
  `SEEN(BEAT, \dut.records.write_beat )
  `PORT(DATA_BITS, data, \dut.records.write_data )
  `PORT(READS, read_enable, \dut.records.read_enable )
  `PORT(READS*WORD, read_word, \dut.records.read_word )
  `PORT(READS*BANKS*64, window, \dut.records.window )
  // Of each loader what it puts out and what it is given.
  localparam integer ANY = BEAT + P + 54, GIVEN = DATA_BITS + C + INFO_BITS + 803;
  logic [ANY*LOADERS-1:0] any;
  logic [GIVEN*LOADERS-1:0] given;
  (* hierconn *) wire [ANY-1:0] \dut.g_loader[0].loader.any ;
  (* hierconn *) wire [GIVEN-1:0] \dut.g_loader[0].loader.given ;
  (* hierconn *) wire [ANY-1:0] \dut.g_loader[1].loader.any ;
  (* hierconn *) wire [GIVEN-1:0] \dut.g_loader[1].loader.given ;
  (* hierconn *) wire [ANY-1:0] \dut.g_loader[2].loader.any ;
  (* hierconn *) wire [GIVEN-1:0] \dut.g_loader[2].loader.given ;
  (* hierconn *) wire [ANY-1:0] \dut.g_loader[3].loader.any ;
  (* hierconn *) wire [GIVEN-1:0] \dut.g_loader[3].loader.given ;
  assign any[2*ANY-1:0] = {\dut.g_loader[1].loader.any , \dut.g_loader[0].loader.any };
  assign given[2*GIVEN-1:0] = {\dut.g_loader[1].loader.given , \dut.g_loader[0].loader.given };
  generate
    if (LOADERS == 4) begin : more
      assign any[ANY*LOADERS-1:2*ANY] = {\dut.g_loader[3].loader.any , \dut.g_loader[2].loader.any };
      assign given[GIVEN*LOADERS-1:2*GIVEN] = {\dut.g_loader[3].loader.given , \dut.g_loader[2].loader.given };
    end
  endgenerate
  wire [P-1:0]  parse = {parse_context, parse_info, parse_error, parse_empty, parse_skew, parse_bits};
  integer       i;
  always @* for (i = 0; i < LOADERS; i = i + 1) {idle[i], brought[i], writes[i]} = any[ANY*i+ANY-1 -: 3];
  always @* for (i = 0; i < LOADERS; i = i + 1) begin
    assert (given[GIVEN*i+GIVEN-1] == (\dut.contexts.load_valid && idle[i] && (idle & ((1 << i) - 1)) == 0));
    assert (given[GIVEN*i+GIVEN-2] == (parse_ready && brought[i] && (brought & ((1 << i) - 1)) == 0));
    assert (given[GIVEN*i +: GIVEN-2] == {rst_n, stream_bits, flush, \dut.contexts.load_context , \dut.contexts.load_tile , \dut.contexts.load_info ,
      request_ready[i], data_valid[i], data, data_last, data_error});
    assert ({request_valid[i], request_address[40*i +: 40], request_beats[10*i +: 10]} == any[ANY*i +: 51]);
    if (brought[i] && (brought & ((1 << i) - 1)) == 0) assert (parse == any[ANY*i+51 +: P]);
    if (writes[i]) begin
      assume ((writes & ~(1 << i)) == 0);
      assert (\dut.records.write_beat == any[ANY*i+51+P +: BEAT]);
    end
  end
  always @* assert (parse_valid == (brought != 0));
endmodule
