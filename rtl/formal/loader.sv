// LOAD begins when no request is in flight, reads the header, derives the geometry from the fields of the header, each from its own, and ends with the
// first error; LOAD during LOAD begins no other. Requests may be accepted when a LOAD has ended and the command that was written last is LOAD; of
// both in one clock LOAD counts. Stream, levels and reads are those of the two parts. BLOCK_LOG2 = 2, MAX_DEPTH = 12, beats of 64 bits.
//
// Clauses: FIL-8, LOAD and DISABLE (docs/decode_unit.md)
// Engine: induction 2 6
// Complete: header and geometry may give anything; each is done once for each start.
// Fault: hmlfc_loader.sv / load || (wanted && !disable_unit) / wanted && !disable_unit
// Fault: hmlfc_loader.sv / state == WAIT && idle / state == WAIT
// Fault: hmlfc_loader.sv / load && state == IDLE / load && state != HEADER
// Fault: hmlfc_loader.sv / if (disable_unit && !load) enable <= 1'b0; / if (disable_unit) enable <= 1'b0;
// Fault: hmlfc_loader.sv / error <= geometry_error / error <= header_error

// In the place of both parts: what they are given, and any outputs.
module hmlfc_header #(parameter integer DATA_BITS = 0) (
  input logic clk, input logic rst_n, input logic start, input logic [39:0] stream_base, input logic [63:0] stream_bytes, output logic done,
  output logic [5:0] error, output logic [8:0] features, output logic [12:0] rows, output logic [12:0] cols, output logic [16:0] width,
  output logic [16:0] height, output logic [3:0] depth, output logic chroma_444, output logic [1:0] block_log2, output logic [6:0] window,
  output logic [7:0] cluster_rows, output logic [7:0] cluster_cols, output logic [3:0] tree_height, output logic [1:0] vector_precision,
  output logic [2:0] disparity_precision, output logic [2:0] motion_tile_log2, output logic [2:0] disparity_grid_log2, output logic [7:0] row_scale,
  output logic [383:0] levels, output logic [63:0] root_offset, output logic [63:0] root_size, output logic [63:0] group_offset,
  output logic [63:0] group_size, output logic [63:0] tile_offset, output logic [63:0] tile_size, output logic request_valid,
  input logic request_ready, output logic [39:0] request_address, output logic [9:0] request_beats, input logic data_valid,
  input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  (* anyseq *) logic [6:0] ends;
  (* anyseq *) logic [889:0] fields;
  (* anyseq *) logic [50:0] asks;
  wire [173:0] given = {rst_n, start, stream_base, stream_bytes, request_ready, data_valid, data, data_last, data_error};
  assign {done, error} = ends;
  assign {features, rows, cols, width, height, depth, chroma_444, block_log2, window, cluster_rows, cluster_cols, tree_height, vector_precision,
          disparity_precision, motion_tile_log2, disparity_grid_log2, row_scale, levels, root_offset, root_size, group_offset, group_size,
          tile_offset, tile_size} = fields;
  assign {request_valid, request_address, request_beats} = asks;
endmodule

module hmlfc_geometry #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0) (
  input logic clk, input logic rst_n, input logic start, output logic done, output logic [5:0] error, input logic [39:0] stream_base,
  input logic [39:0] reference_base, input logic [8:0] features, input logic [12:0] rows, input logic [12:0] cols, input logic [16:0] width,
  input logic [16:0] height, input logic [3:0] depth, input logic chroma_444, input logic [1:0] block_log2, input logic [6:0] window,
  input logic [7:0] cluster_rows, input logic [7:0] cluster_cols, input logic [3:0] tree_height, input logic [1:0] vector_precision,
  input logic [2:0] disparity_precision, input logic [2:0] motion_tile_log2, input logic [2:0] disparity_grid_log2, input logic [7:0] row_scale,
  input logic [383:0] level_entries, input logic [63:0] root_offset, input logic [63:0] root_size, input logic [63:0] group_offset,
  input logic [63:0] group_size, input logic [63:0] tile_offset, input logic [63:0] tile_size, output logic [750:0] stream,
  output logic [983:0] levels
);
  (* anyseq *) logic [6:0] ends;
  (* anyseq *) logic [1734:0] derived;
  wire [889:0] fields = {features, rows, cols, width, height, depth, chroma_444, block_log2, window, cluster_rows, cluster_cols, tree_height,
                         vector_precision, disparity_precision, motion_tile_log2, disparity_grid_log2, row_scale, level_entries, root_offset,
                         root_size, group_offset, group_size, tile_offset, tile_size};
  wire [81:0] given = {rst_n, start, stream_base, reference_base};
  assign {done, error} = ends;
  assign {stream, levels} = derived;
endmodule

module prove_loader #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 12,
  parameter integer DATA_BITS = 64
) (
  input logic clk, input logic load, input logic disable_unit, input logic idle, input logic [63:0] stream_base, input logic [63:0] stream_bytes,
  input logic [63:0] reference_base, input logic request_ready, input logic data_valid, input logic [DATA_BITS-1:0] data, input logic data_last,
  input logic data_error
);
  logic         started = 1'b0;
  logic         loading, enable, flush, request_valid;
  logic [5:0]   error;
  logic [750:0] stream;
  logic [983:0] levels;
  logic [39:0]  request_address;
  logic [9:0]   request_beats;
  hmlfc_loader #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(DATA_BITS)) dut (
    .clk(clk), .rst_n(started), .load(load), .disable_unit(disable_unit), .idle(idle), .loading(loading), .enable(enable), .flush(flush),
    .error(error), .stream_base(stream_base), .stream_bytes(stream_bytes), .reference_base(reference_base), .stream(stream), .levels(levels),
    .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats),
    .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));
  (* hierconn *) wire [6:0] \dut.header.ends ;
  (* hierconn *) wire [889:0] \dut.header.fields ;
  (* hierconn *) wire [50:0] \dut.header.asks ;
  (* hierconn *) wire [173:0] \dut.header.given ;
  (* hierconn *) wire [6:0] \dut.geometry.ends ;
  (* hierconn *) wire [1734:0] \dut.geometry.derived ;
  (* hierconn *) wire [889:0] \dut.geometry.fields ;
  (* hierconn *) wire [81:0] \dut.geometry.given ;
  (* hierconn *) wire [1:0] \dut.state ;
  (* hierconn *) wire \dut.wanted ;

  // What goes on: nothing, a LOAD that waits, its header, its geometry.
  logic [1:0] going = 2'd0;
  logic       wanted = 1'b0;  // the last command is LOAD
  logic       ended = 1'b0;   // a LOAD has ended, and no other begun
  logic [5:0] last_error = 6'd0;
  wire        begins = going == 1 && idle;
  wire        header_ends = going == 2 && \dut.header.ends [6];
  wire        derives = header_ends && \dut.header.ends [5:0] == 0;
  wire        ends = (header_ends && !derives) || (going == 3 && \dut.geometry.ends [6]);
  always @(posedge clk) begin
    started <= 1'b1;
    if (started) begin
      if (load) wanted <= 1'b1;
      else if (disable_unit) wanted <= 1'b0;
      if (going == 0 && load) {going, ended} <= {2'd1, 1'b0};
      if (begins) going <= 2'd2;
      if (derives) going <= 2'd3;
      if (ends) {going, ended, last_error} <= {2'd0, 1'b1, going == 3 ? \dut.geometry.ends [5:0] : \dut.header.ends [5:0]};
    end
  end
  always @* if (started) begin
    if (\dut.header.ends [6]) assume (going == 2);
    if (\dut.geometry.ends [6]) assume (going == 3);
    assert (loading == (going != 0) && enable == (ended && wanted && going == 0));
    if (ended) assert (error == last_error && going == 0);
    assert (flush == begins);
    assert (\dut.header.given == {1'b1, begins, stream_base[39:0], stream_bytes, request_ready, data_valid, data, data_last, data_error});
    assert (\dut.geometry.given == {1'b1, derives, stream_base[39:0], reference_base[39:0]});
    assert (\dut.geometry.fields == \dut.header.fields );
    assert ({stream, levels} == \dut.geometry.derived && {request_valid, request_address, request_beats} == \dut.header.asks );
    assert (\dut.state == going);
    if (going != 0) assert (\dut.wanted == wanted);
  end
endmodule
