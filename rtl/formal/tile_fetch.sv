// In the common part of tile stores each output of the contexts, the loaders and the record memory reaches each input that it is for, in the same
// clock; whatever they put out. The first idle loader takes a load, the first that has a record gives it to the parser, and the one that writes
// writes. 64 bits; the parameters of the stores of residual tiles, motion tiles and disparities.
//
// Clauses: none: tile stores (docs/pipeline.md)
// Engine: bmc 1
// Cut: tile_contexts tile_loader record_ram
// Parts: 3
// Complete: no state of its own; one loader writes at a time, as only one gets data (proof read_port).
// Fault: hmlfc_tile_fetch.sv / idle & ~(idle - 1'b1) / idle & (idle - 1'b1)
// Fault: hmlfc_tile_fetch.sv / .parse_ready(parse_ready && giving[i]) / .parse_ready(parse_ready)
// Fault: hmlfc_tile_fetch.sv / {own_context, own_info, own_error / {own_context, ~own_info, own_error
`define EACH(width, all, a, b, c, d) (* hierconn *) wire [width-1:0] a , b , c , d ; wire [4*(width)-1:0] all = {d , c , b , a };
`define PORT(width, port, b) (* hierconn *) wire [width-1:0] b ; always @* assert (port == b );
`define SAME(width, port, a, b, c, d) (* hierconn *) wire [width-1:0] a , b , c , d ; always @* begin \
    assert (port == a && port == b ); if (LOADERS == 4) assert (port == c && port == d ); end
module prove_tile_fetch #(
  parameter integer PART = 0,
  parameter integer DATA_BITS = 64,
  parameter integer CONTEXTS = PART == 0 ? 2 : 4,
  parameter integer CONTEXT_WORDS = PART == 0 ? 512 : PART == 1 ? 64 : 256,
  parameter integer BANKS = PART == 0 ? 8 : 2,
  parameter integer READS = PART == 0 ? 3 : 2,
  parameter integer LOADERS = PART == 0 ? 4 : 2,
  parameter integer INFO_BITS = PART == 0 ? 9 : PART == 1 ? 17 : 16
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic ask, input logic [43:0] ask_tile,
  input logic [INFO_BITS-1:0] ask_info, input logic parse_ready, input logic loaded_valid, input logic [$clog2(CONTEXTS)-1:0] loaded_context,
  input logic loaded_keep, input logic release_valid, input logic [$clog2(CONTEXTS)-1:0] release_context, input logic [READS-1:0] read_enable,
  input logic [READS*$clog2(CONTEXTS*CONTEXT_WORDS)-1:0] read_word, input logic [LOADERS-1:0] request_ready, input logic [LOADERS-1:0] data_valid,
  input logic [63:0] data, input logic data_last, input logic data_error
);
  localparam integer C = $clog2(CONTEXTS);
  localparam integer W = $clog2(CONTEXTS * CONTEXT_WORDS);
  localparam integer L = LOADERS;
  localparam integer I = INFO_BITS;
  logic           granted, parse_valid, parse_empty;
  logic [C-1:0]   granted_context, parse_context;
  logic [I-1:0]   parse_info;
  logic [5:0]     parse_error, parse_skew;
  logic [17:0]    parse_bits;
  logic [CONTEXTS-1:0] ready;
  logic [READS*BANKS*64-1:0] window;
  logic [L-1:0]   request_valid;
  logic [L*40-1:0] request_address;
  logic [L*10-1:0] request_beats;
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
  `PORT(44, ask_tile, \dut.contexts.tile )
  `PORT(I, ask_info, \dut.contexts.info )
  `PORT(1, granted, \dut.contexts.granted )
  `PORT(C, granted_context, \dut.contexts.context_number )
  `PORT(1, loaded_valid, \dut.contexts.loaded_valid )
  `PORT(C, loaded_context, \dut.contexts.loaded_context )
  `PORT(1, loaded_keep, \dut.contexts.loaded_keep )
  `PORT(CONTEXTS, ready, \dut.contexts.ready )
  `PORT(1, release_valid, \dut.contexts.release_valid )
  `PORT(C, release_context, \dut.contexts.release_context )
  `PORT(64, data, \dut.records.write_data )
  `PORT(READS, read_enable, \dut.records.read_enable )
  `PORT(READS*W, read_word, \dut.records.read_word )
  `PORT(READS*BANKS*64, window, \dut.records.window )
  // The same to all loaders.
  `SAME(1, rst_n, \dut.g_loader[0].loader.rst_n , \dut.g_loader[1].loader.rst_n , \dut.g_loader[2].loader.rst_n , \dut.g_loader[3].loader.rst_n )
  `SAME(751, stream_bits, \dut.g_loader[0].loader.stream , \dut.g_loader[1].loader.stream , \dut.g_loader[2].loader.stream , \dut.g_loader[3].loader.stream )
  `SAME(1, flush, \dut.g_loader[0].loader.flush , \dut.g_loader[1].loader.flush , \dut.g_loader[2].loader.flush , \dut.g_loader[3].loader.flush )
  `SAME(64, data, \dut.g_loader[0].loader.data , \dut.g_loader[1].loader.data , \dut.g_loader[2].loader.data , \dut.g_loader[3].loader.data )
  `SAME(1, data_last, \dut.g_loader[0].loader.data_last , \dut.g_loader[1].loader.data_last , \dut.g_loader[2].loader.data_last , \dut.g_loader[3].loader.data_last )
  `SAME(1, data_error, \dut.g_loader[0].loader.data_error , \dut.g_loader[1].loader.data_error , \dut.g_loader[2].loader.data_error , \dut.g_loader[3].loader.data_error )
  (* hierconn *) wire [C-1:0] \dut.contexts.load_context ;
  `SAME(C, \dut.contexts.load_context , \dut.g_loader[0].loader.load_context , \dut.g_loader[1].loader.load_context , \dut.g_loader[2].loader.load_context , \dut.g_loader[3].loader.load_context )
  (* hierconn *) wire [44-1:0] \dut.contexts.load_tile ;
  `SAME(44, \dut.contexts.load_tile , \dut.g_loader[0].loader.load_tile , \dut.g_loader[1].loader.load_tile , \dut.g_loader[2].loader.load_tile , \dut.g_loader[3].loader.load_tile )
  (* hierconn *) wire [I-1:0] \dut.contexts.load_info ;
  `SAME(I, \dut.contexts.load_info , \dut.g_loader[0].loader.load_info , \dut.g_loader[1].loader.load_info , \dut.g_loader[2].loader.load_info , \dut.g_loader[3].loader.load_info )
  // Of each its own, the first low.
  `EACH(1, of_load_valid, \dut.g_loader[0].loader.load_valid , \dut.g_loader[1].loader.load_valid , \dut.g_loader[2].loader.load_valid , \dut.g_loader[3].loader.load_valid )
  `EACH(1, of_load_ready, \dut.g_loader[0].loader.load_ready , \dut.g_loader[1].loader.load_ready , \dut.g_loader[2].loader.load_ready , \dut.g_loader[3].loader.load_ready )
  `EACH(1, of_write, \dut.g_loader[0].loader.write , \dut.g_loader[1].loader.write , \dut.g_loader[2].loader.write , \dut.g_loader[3].loader.write )
  `EACH(C+$clog2(CONTEXT_WORDS), of_write_beat, \dut.g_loader[0].loader.write_beat , \dut.g_loader[1].loader.write_beat , \dut.g_loader[2].loader.write_beat , \dut.g_loader[3].loader.write_beat )
  `EACH(1, of_parse_valid, \dut.g_loader[0].loader.parse_valid , \dut.g_loader[1].loader.parse_valid , \dut.g_loader[2].loader.parse_valid , \dut.g_loader[3].loader.parse_valid )
  `EACH(1, of_parse_ready, \dut.g_loader[0].loader.parse_ready , \dut.g_loader[1].loader.parse_ready , \dut.g_loader[2].loader.parse_ready , \dut.g_loader[3].loader.parse_ready )
  `EACH(C, of_parse_context, \dut.g_loader[0].loader.parse_context , \dut.g_loader[1].loader.parse_context , \dut.g_loader[2].loader.parse_context , \dut.g_loader[3].loader.parse_context )
  `EACH(I, of_parse_info, \dut.g_loader[0].loader.parse_info , \dut.g_loader[1].loader.parse_info , \dut.g_loader[2].loader.parse_info , \dut.g_loader[3].loader.parse_info )
  `EACH(6, of_parse_error, \dut.g_loader[0].loader.parse_error , \dut.g_loader[1].loader.parse_error , \dut.g_loader[2].loader.parse_error , \dut.g_loader[3].loader.parse_error )
  `EACH(1, of_parse_empty, \dut.g_loader[0].loader.parse_empty , \dut.g_loader[1].loader.parse_empty , \dut.g_loader[2].loader.parse_empty , \dut.g_loader[3].loader.parse_empty )
  `EACH(6, of_parse_skew, \dut.g_loader[0].loader.parse_skew , \dut.g_loader[1].loader.parse_skew , \dut.g_loader[2].loader.parse_skew , \dut.g_loader[3].loader.parse_skew )
  `EACH(18, of_parse_bits, \dut.g_loader[0].loader.parse_bits , \dut.g_loader[1].loader.parse_bits , \dut.g_loader[2].loader.parse_bits , \dut.g_loader[3].loader.parse_bits )
  `EACH(1, of_request_valid, \dut.g_loader[0].loader.request_valid , \dut.g_loader[1].loader.request_valid , \dut.g_loader[2].loader.request_valid , \dut.g_loader[3].loader.request_valid )
  `EACH(1, of_request_ready, \dut.g_loader[0].loader.request_ready , \dut.g_loader[1].loader.request_ready , \dut.g_loader[2].loader.request_ready , \dut.g_loader[3].loader.request_ready )
  `EACH(40, of_request_address, \dut.g_loader[0].loader.request_address , \dut.g_loader[1].loader.request_address , \dut.g_loader[2].loader.request_address , \dut.g_loader[3].loader.request_address )
  `EACH(10, of_request_beats, \dut.g_loader[0].loader.request_beats , \dut.g_loader[1].loader.request_beats , \dut.g_loader[2].loader.request_beats , \dut.g_loader[3].loader.request_beats )
  `EACH(1, of_data_valid, \dut.g_loader[0].loader.data_valid , \dut.g_loader[1].loader.data_valid , \dut.g_loader[2].loader.data_valid , \dut.g_loader[3].loader.data_valid )
  localparam integer B = C + $clog2(CONTEXT_WORDS);
  (* hierconn *) wire \dut.contexts.load_valid ;
  (* hierconn *) wire \dut.contexts.load_ready ;
  (* hierconn *) wire \dut.records.write ;
  (* hierconn *) wire [B-1:0] \dut.records.write_beat ;
  wire [L-1:0] idle = of_load_ready[L-1:0];
  wire [L-1:0] brought = of_parse_valid[L-1:0];
  always @* begin
    assume ((of_write[L-1:0] & (of_write[L-1:0] - 1'b1)) == 0);
    assert (of_request_valid[L-1:0] == request_valid && of_request_ready[L-1:0] == request_ready && of_data_valid[L-1:0] == data_valid);
    assert (of_request_address[40*L-1:0] == request_address && of_request_beats[10*L-1:0] == request_beats);
    assert (\dut.contexts.load_ready == (idle != 0) && parse_valid == (brought != 0) && \dut.records.write == (of_write[L-1:0] != 0));
    for (integer i = 0; i < L; i = i + 1) begin
      assert (of_load_valid[i] == (\dut.contexts.load_valid && idle[i] && L'(idle << (L - i)) == 0));
      assert (of_parse_ready[i] == (parse_ready && brought[i] && L'(brought << (L - i)) == 0));
      if (brought[i] && L'(brought << (L - i)) == 0) begin
        assert (parse_context == of_parse_context[C*i +: C] && parse_info == of_parse_info[I*i +: I] && parse_error == of_parse_error[6*i +: 6]);
        assert (parse_empty == of_parse_empty[i] && parse_skew == of_parse_skew[6*i +: 6] && parse_bits == of_parse_bits[18*i +: 18]);
      end
      if (of_write[i]) assert (\dut.records.write_beat == of_write_beat[B*i +: B]);
    end
  end
endmodule
