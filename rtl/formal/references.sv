// A block that enters goes to reference_ask with the references of its image; each window that this asks for to the queue of its cache and on to the
// cache, field by field; each answer, read and beat to its port; what is left of the block to the queue before compose and out of the unit. All in
// the same clock, whatever the modules inside put out. BLOCK_LOG2 = 2, MAX_DEPTH = 12, 64 bits.
//
// Clauses: none: reference windows (docs/pipeline.md)
// Engine: bmc 1
// Complete: no state; the modules inside may give anything.
// Fault: hmlfc_references.sv / .in_width(slot[51+:15]) / .in_width(slot[36+:15])
// Fault: hmlfc_references.sv / .data_valid(data_valid[c]) / .data_valid(data_valid[0])
// Fault: hmlfc_references.sv / .in_data({pending, pending_residual}) / .in_data({pending, in_residual})
// Fault: hmlfc_references.sv / .in_section(slot[ADDRESS_BITS+79]) / .in_section(1'b0)

// In the place of the modules inside: what they are given, and any outputs.
module hmlfc_fifo #(parameter integer WIDTH = 0, parameter integer DEPTH = 0) (
  input logic clk, input logic rst_n, input logic in_valid, output logic in_ready, input logic [WIDTH-1:0] in_data, output logic out_valid,
  input logic out_ready, output logic [WIDTH-1:0] out_data, output logic [$clog2(DEPTH):0] count);
  (* anyseq *) logic [WIDTH+$clog2(DEPTH)+2:0] any;
  assign {count, in_ready, out_valid, out_data} = any;
  wire [WIDTH+2:0] given = {rst_n, in_valid, out_ready, in_data};
endmodule

module hmlfc_reference_ask #(parameter integer BLOCK_LOG2 = 0, parameter integer RESIDUAL_BITS = 0) (
  input logic clk, input logic rst_n, input logic [750:0] stream, input logic [hmlfc_pkg::IMAGE_REFERENCES_BITS-1:0] image,
  input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow, input logic in_valid, output logic in_ready, input logic in_has_residual,
  input logic [RESIDUAL_BITS-1:0] in_residual, output logic a_valid, input logic a_ready, output logic [119:0] a_window, output logic b_valid,
  input logic b_ready, output logic [119:0] b_window, output logic out_valid, input logic out_ready,
  output logic [hmlfc_pkg::PENDING_BITS-1:0] out_pending, output logic [RESIDUAL_BITS-1:0] out_residual);
  (* anyseq *) logic [hmlfc_pkg::PENDING_BITS+RESIDUAL_BITS+243:0] any;
  assign {in_ready, a_valid, a_window, b_valid, b_window, out_valid, out_pending, out_residual} = any;
  wire [hmlfc_pkg::IMAGE_REFERENCES_BITS+hmlfc_pkg::FLOW_BITS+RESIDUAL_BITS+756:0] given = {
    rst_n, stream, image, in_flow, in_valid, in_has_residual, in_residual, a_ready, b_ready, out_ready};
endmodule

module hmlfc_reference_cache #(parameter integer BLOCK_LOG2 = 0, parameter integer SAMPLE_BITS = 0, parameter integer DATA_BITS = 0,
                               parameter integer STRIPS = 0, parameter integer SECTIONS = 0) (
  input logic clk, input logic rst_n, input logic flush, input logic in_valid, output logic in_ready, input logic [39:0] in_address,
  input logic [1:0] in_plane, input logic in_section, input logic [10:0] in_strips_x, input logic [14:0] in_width, input logic [14:0] in_height,
  input logic [16:0] in_x, input logic [16:0] in_y, input logic in_extra_x, input logic in_extra_y, output logic out_valid, input logic out_ready,
  output logic [5:0] out_error, output logic [25*SAMPLE_BITS-1:0] out_window, output logic request_valid, input logic request_ready,
  output logic [39:0] request_address, output logic [9:0] request_beats, input logic data_valid, input logic [DATA_BITS-1:0] data,
  input logic data_last, input logic data_error);
  (* anyseq *) logic [25*SAMPLE_BITS+58:0] any;
  assign {in_ready, out_valid, out_error, out_window, request_valid, request_address, request_beats} = any;
  // As reference_ask gives a window: {section, address, plane, strips_x, width, height, x, y, extra_x, extra_y}.
  wire [119:0] slot = {in_section, in_address, in_plane, in_strips_x, in_width, in_height, in_x, in_y, in_extra_x, in_extra_y};
  wire [DATA_BITS+127:0] given = {rst_n, flush, in_valid, slot, out_ready, request_ready, data_valid, data, data_last, data_error};
  wire [47:0] kind = {16'(STRIPS), 8'(SECTIONS), 8'(BLOCK_LOG2), 8'(SAMPLE_BITS), 8'(DATA_BITS)};
endmodule

module prove_references (
  input logic clk, input logic rst_n, input logic [750:0] stream, input logic flush, input logic in_valid, input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow,
  input logic [hmlfc_pkg::IMAGE_REFERENCES_BITS-1:0] in_image, input logic in_has_residual, input logic [223:0] in_residual, input logic out_ready,
  input logic [1:0] window_ready, input logic [1:0] request_ready, input logic [1:0] data_valid, input logic [63:0] data, input logic data_last,
  input logic data_error
);
  localparam integer P = hmlfc_pkg::PENDING_BITS;
  localparam integer W = 25 * 14;  // of a window
  logic           in_ready, out_valid;
  logic [P-1:0]   out_pending;
  logic [223:0]   out_residual;
  logic [1:0]     window_valid, request_valid;
  logic [11:0]    window_error;
  logic [2*W-1:0] window;
  logic [79:0]    request_address;
  logic [19:0]    request_beats;
  hmlfc_references #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .DATA_BITS(64), .CACHE_STRIPS(64)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream), .flush(flush), .in_valid(in_valid), .in_ready(in_ready), .in_flow(in_flow), .in_image(in_image),
    .in_has_residual(in_has_residual), .in_residual(in_residual), .out_valid(out_valid), .out_ready(out_ready), .out_pending(out_pending),
    .out_residual(out_residual), .window_valid(window_valid), .window_ready(window_ready), .window_error(window_error), .window(window),
    .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats),
    .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));

  // What each of the modules inside gives.
  (* hierconn *) wire [P+467:0] \dut.reference_ask.any ;
  (* hierconn *) wire [125:0]   \dut.g_cache[0].before_cache.any ;
  (* hierconn *) wire [125:0]   \dut.g_cache[1].before_cache.any ;
  (* hierconn *) wire [W+58:0]  \dut.g_cache[0].cache.any ;
  (* hierconn *) wire [W+58:0]  \dut.g_cache[1].cache.any ;
  (* hierconn *) wire [P+234:0] \dut.before_compose.any ;
  logic           a_valid, b_valid, pending_valid, a_ready, b_ready, a_slot_valid, b_slot_valid, a_slot_ready, b_slot_ready, pending_ready, asked_ready;
  logic           left_valid;
  logic [119:0]   a_window, b_window, a_slot, b_slot;
  logic [P+223:0] pending, left;
  logic [3:0]     a_count, b_count;
  logic [8:0]     left_count;
  logic [1:0]     valid, request;
  logic [11:0]    error;
  logic [2*W-1:0] samples;
  logic [79:0]    address;
  logic [19:0]    beats;
  assign {asked_ready, a_valid, a_window, b_valid, b_window, pending_valid, pending} = \dut.reference_ask.any ;
  assign {a_count, a_ready, a_slot_valid, a_slot} = \dut.g_cache[0].before_cache.any ;
  assign {b_count, b_ready, b_slot_valid, b_slot} = \dut.g_cache[1].before_cache.any ;
  assign {a_slot_ready, valid[0], error[5:0], samples[W-1:0], request[0], address[39:0], beats[9:0]} = \dut.g_cache[0].cache.any ;
  assign {b_slot_ready, valid[1], error[11:6], samples[2*W-1:W], request[1], address[79:40], beats[19:10]} = \dut.g_cache[1].cache.any ;
  assign {left_count, pending_ready, left_valid, left} = \dut.before_compose.any ;

  // And is given.
  (* hierconn *) wire [hmlfc_pkg::IMAGE_REFERENCES_BITS+hmlfc_pkg::FLOW_BITS+980:0] \dut.reference_ask.given ;
  (* hierconn *) wire [122:0]   \dut.g_cache[0].before_cache.given ;
  (* hierconn *) wire [122:0]   \dut.g_cache[1].before_cache.given ;
  (* hierconn *) wire [191:0]   \dut.g_cache[0].cache.given ;
  (* hierconn *) wire [191:0]   \dut.g_cache[1].cache.given ;
  (* hierconn *) wire [47:0]    \dut.g_cache[0].cache.kind ;
  (* hierconn *) wire [47:0]    \dut.g_cache[1].cache.kind ;
  (* hierconn *) wire [P+226:0] \dut.before_compose.given ;
  always @* begin
    assert (\dut.reference_ask.given == {rst_n, stream, in_image, in_flow, in_valid, in_has_residual, in_residual, a_ready, b_ready, pending_ready});
    assert (\dut.g_cache[0].before_cache.given == {rst_n, a_valid, a_slot_ready, a_window});
    assert (\dut.g_cache[1].before_cache.given == {rst_n, b_valid, b_slot_ready, b_window});
    assert (\dut.g_cache[0].cache.given == {rst_n, flush, a_slot_valid, a_slot, window_ready[0], request_ready[0], data_valid[0], data, data_last, data_error});
    assert (\dut.g_cache[1].cache.given == {rst_n, flush, b_slot_valid, b_slot, window_ready[1], request_ready[1], data_valid[1], data, data_last, data_error});
    assert (\dut.g_cache[0].cache.kind == {16'd64, 8'd1, 8'd2, 8'd14, 8'd64} && \dut.g_cache[1].cache.kind == {16'd128, 8'd2, 8'd2, 8'd14, 8'd64});
    assert (\dut.before_compose.given == {rst_n, pending_valid, out_ready, pending});
    assert (in_ready == asked_ready && {out_valid, out_pending, out_residual} == {left_valid, left});
    assert (window_valid == valid && window_error == error && window == samples);
    assert (request_valid == request && request_address == address && request_beats == beats);
  end
endmodule
