// A step from any state: a load starts a walk, its end gives the error, none or what is to be fetched: the beats that hold the record, no more than
// fit into the context's part; where it lies; each beat of it is written to the next place, a bus error is told; then the parser gets it, and the next
// load is taken. The walk and the fetch share the read master, one at a time.
// 64 bits; the parameters of the stores of residual tiles, motion tiles and disparities.
//
// Clauses: section 11 (a record longer than its part); IDX-7 (docs/pipeline.md)
// Engine: bmc 2
// Cut: tile_walk
// Parts: 3
// Complete: any step; the walk's outputs may be anything.
// Fault: hmlfc_tile_loader.sv / span > 33'(MAX_BYTES) / span >= 33'(MAX_BYTES)+33'd8
// Fault: hmlfc_tile_loader.sv / record_bytes[31:POSITION_BITS-3] != 0 / record_bytes[31:POSITION_BITS-2] != 0
// Fault: hmlfc_tile_loader.sv / beat <= beat + 1'b1 / beat <= beat
// Fault: hmlfc_tile_loader.sv / .request_ready(request_ready && !fetching) / .request_ready(request_ready)
`include "hmlfc_tables.svh"

module prove_tile_loader #(
  parameter integer PART = 0,
  parameter integer DATA_BITS = 64,
  parameter integer CONTEXTS = PART == 0 ? 2 : 4,
  parameter integer RECORD_BEATS = PART == 0 ? 512 : PART == 1 ? 64 : 256,
  parameter integer INFO_BITS = PART == 0 ? 9 : PART == 1 ? 17 : 16
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic load_valid,
  input logic [$clog2(CONTEXTS)-1:0] load_context, input logic [43:0] load_tile, input logic [INFO_BITS-1:0] load_info, input logic parse_ready,
  input logic request_ready, input logic data_valid, input logic [63:0] data, input logic data_last, input logic data_error
);
  localparam integer C = $clog2(CONTEXTS);
  localparam integer B = $clog2(RECORD_BEATS);
  localparam integer I = INFO_BITS;
  localparam integer IDLE = 0, WALK = 1, MEASURE = 2, ASK = 3, FETCH = 4, PARSE = 5;
  logic           load_ready, write, parse_valid, parse_empty, request_valid;
  logic [C+B-1:0] write_beat;
  logic [C-1:0]   parse_context;
  logic [I-1:0]   parse_info;
  logic [5:0]     parse_error, parse_skew;
  logic [17:0]    parse_bits;
  logic [39:0]    request_address;
  logic [9:0]     request_beats;
  hmlfc_tile_loader #(.DATA_BITS(DATA_BITS), .CONTEXTS(CONTEXTS), .RECORD_BEATS(RECORD_BEATS), .INFO_BITS(INFO_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .load_valid(load_valid), .load_ready(load_ready), .load_context(load_context),
    .load_tile(load_tile), .load_info(load_info), .write(write), .write_beat(write_beat), .parse_valid(parse_valid), .parse_ready(parse_ready),
    .parse_context(parse_context), .parse_info(parse_info), .parse_error(parse_error), .parse_empty(parse_empty), .parse_skew(parse_skew),
    .parse_bits(parse_bits), .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address),
    .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));
  (* hierconn *) wire [2:0]  \dut.state ;
  (* hierconn *) wire [9:0]  \dut.beats ;
  (* hierconn *) wire [B-1:0] \dut.beat ;
  `define PORT(width, port, b) (* hierconn *) wire [width-1:0] b ; always @* assert (port == b );
  `define WALKS(width, b) (* hierconn *) wire [width-1:0] b ;
  `WALKS(1, \dut.walk.idle )
  `WALKS(1, \dut.walk.done )
  `WALKS(6, \dut.walk.error )
  `WALKS(1, \dut.walk.empty )
  `WALKS(40, \dut.walk.record_address )
  `WALKS(32, \dut.walk.record_bytes )
  `WALKS(1, \dut.walk.request_valid )
  `WALKS(40, \dut.walk.request_address )
  `WALKS(10, \dut.walk.request_beats )
  wire [2:0]  state = \dut.state ;
  wire        fetching = state == ASK || state == FETCH;
  wire        takes = load_valid && load_ready;
  wire [39:0] address = \dut.walk.record_address ;
  wire [31:0] bytes = \dut.walk.record_bytes ;
  wire [40:0] first = address / 8, behind = ({1'b0, address} + {9'd0, bytes} + 41'd7) / 8;  // beats
  wire [40:0] beats = behind - first;
  wire [34:0] bits = {3'd0, bytes} * 8;
  `PORT(1, rst_n, \dut.walk.rst_n )
  `PORT(751, stream_bits, \dut.walk.stream )
  `PORT(1, flush, \dut.walk.flush )
  `PORT(1, takes, \dut.walk.start )
  `PORT(44, load_tile, \dut.walk.tile )
  `PORT(1, (request_ready && !fetching), \dut.walk.request_ready )
  `PORT(1, (data_valid && !fetching), \dut.walk.data_valid )
  `PORT(64, data, \dut.walk.data )
  `PORT(1, data_last, \dut.walk.data_last )
  `PORT(1, data_error, \dut.walk.data_error )

  logic [2:0] next;
  always @* begin
    next = state;
    case (state)
      IDLE: if (takes) next = WALK;
      WALK: if (\dut.walk.done ) next = \dut.walk.error != 0 || \dut.walk.empty ? PARSE : MEASURE;
      MEASURE: next = ASK;
      ASK: if (request_ready) next = FETCH;
      FETCH: if (data_valid && data_last) next = PARSE;
      default: if (parse_ready) next = IDLE;
    endcase
  end
  logic         was = 1'b0;
  logic [2:0]   after;
  logic [C-1:0] next_context;
  logic [I-1:0] next_info;
  logic [5:0]   next_error, next_skew;
  logic [17:0]  next_bits;
  logic [9:0]   next_beats;
  logic [B-1:0] next_beat;
  logic         next_empty;
  wire          measures = state == MEASURE;
  always @(posedge clk) begin
    was <= 1'b1;
    after <= rst_n ? next : IDLE;
    {next_context, next_info} <= takes ? {load_context, load_info} : {parse_context, parse_info};
    next_error <= state == WALK && \dut.walk.done ? \dut.walk.error : state == FETCH && data_valid && data_error ? 6'(HMLFC_ERROR_BUS_ERROR) : parse_error;
    next_empty <= state == WALK && \dut.walk.done ? \dut.walk.empty : parse_empty;
    next_skew <= measures ? 6'(8 * address[2:0]) : parse_skew;
    next_bits <= !measures ? parse_bits : bits > 35'h3ffff ? 18'h3ffff : bits[17:0];
    next_beats <= !measures ? \dut.beats : beats > RECORD_BEATS ? RECORD_BEATS : beats[9:0];
    next_beat <= measures ? {B{1'b0}} : \dut.beat + B'(write);
  end
  always @* begin
    assume (state <= PARSE);
    assert (load_ready == (state == IDLE && \dut.walk.idle ) && parse_valid == (state == PARSE) && write == (state == FETCH && data_valid));
    if (write) assert (write_beat == {parse_context, \dut.beat });
    assert (request_valid == (fetching ? state == ASK : \dut.walk.request_valid ));
    if (state == ASK) assert (request_address == {address[39:3], 3'd0} && request_beats == \dut.beats );
    if (!fetching) assert (request_address == \dut.walk.request_address && request_beats == \dut.walk.request_beats );
    if (was) begin
      assert (state == after && parse_context == next_context && parse_info == next_info && parse_error == next_error);
      assert (parse_empty == next_empty && parse_skew == next_skew && parse_bits == next_bits && \dut.beats == next_beats && \dut.beat == next_beat);
    end
  end
endmodule
