// Loading of a tile, from any state, step by step: a load is taken when the walk through the index is idle, too; the walk's request goes to the read
// master, or that of the record, as many whole beats as it touches or a context has; its beats go into the context one after the other; then
// the parser gets context, information, error, and where the record lies.
//
// Clauses: IDX-6, section 11
// Engine: bmc 2
// Cut: tile_walk
// Complete: any state and one step from it; the walk may give anything.
// Fault: hmlfc_tile_loader.sv / 10'(RECORD_BEATS) : / 10'(RECORD_BEATS - 1) :
// Fault: hmlfc_tile_loader.sv / 33'((1 << BEAT_LOG2) - 1) / 33'(1 << BEAT_LOG2)
// Fault: hmlfc_tile_loader.sv / record_bytes[31:POSITION_BITS-3] != 0 / record_bytes[31:POSITION_BITS-2] != 0
// Fault: hmlfc_tile_loader.sv / if (data_error) parse_error / if (data_error && data_last) parse_error
// Fault: hmlfc_tile_loader.sv / .request_ready(request_ready && !fetching) / .request_ready(request_ready)
`include "hmlfc_tables.svh"
`include "inside.svh"
module prove_tile_loader #(
  parameter integer DATA_BITS = 64,
  parameter integer CONTEXTS = 4,
  parameter integer RECORD_BEATS = 64,
  parameter integer INFO_BITS = 17,
  localparam integer C = $clog2(CONTEXTS),
  localparam integer B = $clog2(RECORD_BEATS),
  localparam integer T = hmlfc_pkg::TILE_BITS
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic load_valid, input logic [C-1:0] load_context,
  input logic [T-1:0] load_tile, input logic [INFO_BITS-1:0] load_info, input logic parse_ready, input logic request_ready, input logic data_valid,
  input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  logic           load_ready, write, parse_valid, parse_empty, request_valid;
  logic [C+B-1:0] write_beat;
  logic [C-1:0]   context_number;
  logic [INFO_BITS-1:0] info;
  logic [5:0]     error, skew;
  logic [17:0]    bits;
  logic [39:0]    request_address;
  logic [9:0]     request_beats;
  hmlfc_tile_loader #(.DATA_BITS(DATA_BITS), .CONTEXTS(CONTEXTS), .RECORD_BEATS(RECORD_BEATS), .INFO_BITS(INFO_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .load_valid(load_valid), .load_ready(load_ready), .load_context(load_context),
    .load_tile(load_tile), .load_info(load_info), .write(write), .write_beat(write_beat), .parse_valid(parse_valid), .parse_ready(parse_ready),
    .parse_context(context_number), .parse_info(info), .parse_error(error), .parse_empty(parse_empty), .parse_skew(skew), .parse_bits(bits),
    .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats),
    .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));
  `SEEN(3, \dut.state )
  `SEEN(10, \dut.beats )
  `SEEN(B, \dut.beat )
  `SEEN(1, \dut.walk.rst_n )
  `SEEN(751, \dut.walk.stream )
  `SEEN(1, \dut.walk.flush )
  `SEEN(1, \dut.walk.start )
  `SEEN(T, \dut.walk.tile )
  `SEEN(1, \dut.walk.idle )
  `SEEN(1, \dut.walk.done )
  `SEEN(6, \dut.walk.error )
  `SEEN(1, \dut.walk.empty )
  `SEEN(40, \dut.walk.record_address )
  `SEEN(32, \dut.walk.record_bytes )
  `SEEN(1, \dut.walk.request_valid )
  `SEEN(1, \dut.walk.request_ready )
  `SEEN(40, \dut.walk.request_address )
  `SEEN(10, \dut.walk.request_beats )
  `SEEN(1, \dut.walk.data_valid )
  `SEEN(DATA_BITS, \dut.walk.data )
  `SEEN(1, \dut.walk.data_last )
  `SEEN(1, \dut.walk.data_error )
  localparam logic [2:0] IDLE = 0, WALK = 1, MEASURE = 2, ASK = 3, FETCH = 4, PARSE = 5;
  wire [2:0]  state = \dut.state ;
  wire        own = state == ASK || state == FETCH;  // the read master's answers are those of the record
  wire        begins = load_valid && load_ready;
  wire [34:0] record_bits = {\dut.walk.record_bytes , 3'b0};
  wire [33:0] touched = {2'b0, \dut.walk.record_bytes } + \dut.walk.record_address [2:0];  // bytes from the begin of its first beat on
  wire [33:0] whole = (touched + 34'd7) / 8;

  logic       was = 1'b0, was_reset = 1'b0, next_empty;
  logic [2:0] next_state;
  logic [C-1:0] next_context;
  logic [INFO_BITS-1:0] next_info;
  logic [5:0] next_error, next_skew;
  logic [17:0] next_bits;
  logic [9:0] next_beats;
  logic [B-1:0] next_beat;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    {next_state, next_context, next_info, next_error, next_empty} <= {state, context_number, info, error, parse_empty};
    {next_skew, next_bits, next_beats, next_beat} <= {skew, bits, \dut.beats , \dut.beat };
    if (begins) {next_state, next_context, next_info} <= {WALK, load_context, load_info};
    if (state == WALK && \dut.walk.done ) begin
      next_state <= \dut.walk.error == 0 && !\dut.walk.empty ? MEASURE : PARSE;
      {next_error, next_empty} <= {\dut.walk.error , \dut.walk.empty };
    end
    if (state == MEASURE) begin
      {next_state, next_beat} <= {ASK, {B{1'b0}}};
      next_skew <= {\dut.walk.record_address [2:0], 3'b0};
      next_bits <= record_bits >= (1 << 18) ? (1 << 18) - 1 : record_bits;
      next_beats <= whole > RECORD_BEATS ? RECORD_BEATS : whole;
    end
    if (state == ASK && request_ready) next_state <= FETCH;
    if (write) begin
      next_beat <= \dut.beat + 1'b1;
      if (data_error) next_error <= HMLFC_ERROR_BUS_ERROR;
      if (data_last) next_state <= PARSE;
    end
    if (state == PARSE && parse_ready) next_state <= IDLE;
  end
  always @* begin
    assume (state <= PARSE);
    assert (load_ready == (state == IDLE && \dut.walk.idle ) && \dut.walk.start == begins);
    assert (\dut.walk.rst_n == rst_n && \dut.walk.stream == stream_bits && \dut.walk.flush == flush);
    if (begins) assert (\dut.walk.tile == load_tile);
    assert (request_valid == (state == ASK || (!own && \dut.walk.request_valid )) && \dut.walk.request_ready == (!own && request_ready));
    assert ({request_address, request_beats} == (own ? {\dut.walk.record_address [39:3], 3'd0, \dut.beats } : {\dut.walk.request_address , \dut.walk.request_beats }));
    assert (\dut.walk.data_valid == (!own && data_valid));
    assert ({\dut.walk.data , \dut.walk.data_last , \dut.walk.data_error } == {data, data_last, data_error});
    assert (write == (state == FETCH && data_valid) && write_beat == {context_number, \dut.beat } && parse_valid == (state == PARSE));
    if (was_reset) assert (state == IDLE);
    if (was) begin
      assert ({state, context_number, info, error, parse_empty} == {next_state, next_context, next_info, next_error, next_empty});
      assert ({skew, bits, \dut.beats , \dut.beat } == {next_skew, next_bits, next_beats, next_beat});
    end
  end
endmodule
