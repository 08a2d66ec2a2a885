// A window goes to the lookup, with what this finds to the queue, field by field, and from its front to the lines, once as many strips have been taken as
// it missed; only then it leaves the queue. Before, each strip that strip_fill offers is taken and written, and counted from 0 for each window. What the
// lookup asks for goes to strip_fill; a spoiled strip makes it forget. A step from any state, whatever the modules inside put out.
// BLOCK_LOG2 = 2, samples of 14 bits, 64 bits; 64 strips.
//
// Clauses: none: reference windows (docs/pipeline.md)
// Engine: bmc 2
// Complete: any step; the modules inside may give anything.
// Fault: hmlfc_reference_cache.sv / .in_two_y(op_two_y) / .in_two_y(op_two_x)
// Fault: hmlfc_reference_cache.sv / assign op_ready = complete && lines_ready / assign op_ready = lines_ready
// Fault: hmlfc_reference_cache.sv / if (!rst_n || (op_valid && op_ready)) filled / if (!rst_n) filled
// Fault: hmlfc_reference_cache.sv / .write_place(strip_place) / .write_place(ask_place)

// In the place of the modules inside: what they are given, and any outputs.
module hmlfc_reference_lookup #(parameter integer BLOCK_LOG2 = 0, parameter integer STRIPS = 0, parameter integer SECTIONS = 0) (
  input logic clk, input logic rst_n, input logic flush, input logic forget, input logic in_valid, output logic in_ready, input logic [39:0] in_address,
  input logic [1:0] in_plane, input logic in_section, input logic [10:0] in_strips_x, input logic [14:0] in_width, input logic [14:0] in_height,
  input logic [16:0] in_x, input logic [16:0] in_y, input logic in_extra_x, input logic in_extra_y, output logic ask, input logic ask_ready,
  output logic [39:0] ask_address, output logic [$clog2(STRIPS)-1:0] ask_place, output logic out_valid, input logic out_ready,
  output logic [12:0] out_block_x, output logic [12:0] out_block_y, output logic out_two_x, output logic out_two_y, output logic [14:0] out_select_x,
  output logic [14:0] out_select_y, output logic [4*$clog2(STRIPS)-9:0] out_places, output logic [2:0] out_missed);
  (* anyseq *) logic [5*$clog2(STRIPS)+97:0] any;
  assign {in_ready, ask, ask_address, ask_place, out_valid, out_block_x, out_block_y, out_two_x, out_two_y, out_select_x, out_select_y, out_places,
          out_missed} = any;
  wire [125:0] given = {rst_n, flush, forget, in_valid, in_address, in_plane, in_section, in_strips_x, in_width, in_height, in_x, in_y, in_extra_x,
                        in_extra_y, ask_ready, out_ready};
  wire [31:0] kind = {16'(STRIPS), 8'(SECTIONS), 8'(BLOCK_LOG2)};
endmodule

module hmlfc_fifo #(parameter integer WIDTH = 0, parameter integer DEPTH = 0) (
  input logic clk, input logic rst_n, input logic in_valid, output logic in_ready, input logic [WIDTH-1:0] in_data, output logic out_valid,
  input logic out_ready, output logic [WIDTH-1:0] out_data, output logic [$clog2(DEPTH):0] count);
  (* anyseq *) logic [WIDTH+$clog2(DEPTH)+2:0] any;
  assign {count, in_ready, out_valid, out_data} = any;
  wire [WIDTH+2:0] given = {rst_n, in_valid, out_ready, in_data};
endmodule

module hmlfc_strip_fill #(parameter integer BLOCK_LOG2 = 0, parameter integer SAMPLE_BITS = 0, parameter integer DATA_BITS = 0,
                          parameter integer PLACE_BITS = 0, parameter integer SLOTS = 0) (
  input logic clk, input logic rst_n, input logic ask, output logic ask_ready, input logic [39:0] ask_address, input logic [PLACE_BITS-1:0] ask_place,
  output logic valid, output logic [PLACE_BITS-1:0] place, output logic [64*SAMPLE_BITS+23:0] lines, input logic take, output logic request_valid,
  input logic request_ready, output logic [39:0] request_address, output logic [9:0] request_beats, input logic data_valid,
  input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error);
  (* anyseq *) logic [PLACE_BITS+64*SAMPLE_BITS+76:0] any;
  assign {ask_ready, valid, place, lines, request_valid, request_address, request_beats} = any;
  wire [PLACE_BITS+DATA_BITS+46:0] given = {rst_n, ask, ask_address, ask_place, take, request_ready, data_valid, data, data_last, data_error};
  wire [31:0] kind = {8'(PLACE_BITS), 8'(BLOCK_LOG2), 8'(SAMPLE_BITS), 8'(DATA_BITS)};
endmodule

module hmlfc_reference_lines #(parameter integer BLOCK_LOG2 = 0, parameter integer SAMPLE_BITS = 0, parameter integer PLACE_BITS = 0) (
  input logic clk, input logic rst_n, input logic write, input logic [PLACE_BITS+1:0] write_place, input logic [64*SAMPLE_BITS+23:0] write_lines,
  input logic in_valid, output logic in_ready, input logic [12:0] in_block_x, input logic [12:0] in_block_y, input logic in_two_x, input logic in_two_y,
  input logic [14:0] in_select_x, input logic [14:0] in_select_y, input logic [4*PLACE_BITS-1:0] in_places, output logic out_valid, input logic out_ready,
  output logic [5:0] out_error, output logic [25*SAMPLE_BITS-1:0] out_window, output logic spoiled);
  (* anyseq *) logic [25*SAMPLE_BITS+8:0] any;
  assign {in_ready, out_valid, out_error, out_window, spoiled} = any;
  // A window as the lookup gives it.
  wire [4*PLACE_BITS+57:0] found = {in_block_x, in_block_y, in_two_x, in_two_y, in_select_x, in_select_y, in_places};
  wire [5*PLACE_BITS+64*SAMPLE_BITS+87:0] given = {rst_n, write, write_place, write_lines, in_valid, found, out_ready};
  wire [23:0] kind = {8'(PLACE_BITS), 8'(BLOCK_LOG2), 8'(SAMPLE_BITS)};
endmodule

module prove_reference_cache #(
  parameter integer STRIPS = 64,
  parameter integer SECTIONS = 1
) (
  input logic clk, input logic rst_n, input logic flush, input logic in_valid, input logic [39:0] in_address, input logic [1:0] in_plane,
  input logic in_section, input logic [10:0] in_strips_x, input logic [14:0] in_width, input logic [14:0] in_height, input logic [16:0] in_x,
  input logic [16:0] in_y, input logic in_extra_x, input logic in_extra_y, input logic out_ready, input logic request_ready, input logic data_valid,
  input logic [63:0] data, input logic data_last, input logic data_error
);
  localparam integer P = $clog2(STRIPS);     // bits of a place with its bank
  localparam integer F = 4 * (P - 2) + 58;   // of what the lookup finds
  localparam integer L = 64 * 14 + 24;       // of a strip's lines
  localparam integer W = 25 * 14;            // of a window
  logic         in_ready, out_valid, request_valid;
  logic [5:0]   out_error;
  logic [W-1:0] out_window;
  logic [39:0]  request_address;
  logic [9:0]   request_beats;
  hmlfc_reference_cache #(.BLOCK_LOG2(2), .SAMPLE_BITS(14), .DATA_BITS(64), .STRIPS(STRIPS), .SECTIONS(SECTIONS)) dut (
    .clk(clk), .rst_n(rst_n), .flush(flush), .in_valid(in_valid), .in_ready(in_ready), .in_address(in_address), .in_plane(in_plane),
    .in_section(in_section), .in_strips_x(in_strips_x), .in_width(in_width), .in_height(in_height), .in_x(in_x), .in_y(in_y), .in_extra_x(in_extra_x),
    .in_extra_y(in_extra_y), .out_valid(out_valid), .out_ready(out_ready), .out_error(out_error), .out_window(out_window),
    .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats),
    .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));

  // What each of the modules inside gives.
  (* hierconn *) wire [5*P+97:0] \dut.lookup.any ;
  (* hierconn *) wire [F+12:0]   \dut.waiting.any ;
  (* hierconn *) wire [P+L+52:0] \dut.fill.any ;
  (* hierconn *) wire [W+8:0]    \dut.lines.any ;
  logic         taken, ask, found_valid, room, waits, asked, offered, requests, reads, leaves, spoiled;
  logic [39:0]  ask_address, address;
  logic [P-1:0] ask_place, place;
  logic [F-1:0] found, front;
  logic [2:0]   found_missed, missed;
  logic [7:0]   count;
  logic [L-1:0] lines;
  logic [9:0]   beats;
  logic [5:0]   error;
  logic [W-1:0] window;
  assign {taken, ask, ask_address, ask_place, found_valid, found, found_missed} = \dut.lookup.any ;
  assign {count, room, waits, front, missed} = \dut.waiting.any ;
  assign {asked, offered, place, lines, requests, address, beats} = \dut.fill.any ;
  assign {reads, leaves, error, window, spoiled} = \dut.lines.any ;

  // And is given.
  (* hierconn *) wire [125:0]       \dut.lookup.given ;
  (* hierconn *) wire [F+5:0]       \dut.waiting.given ;
  (* hierconn *) wire [P+110:0]     \dut.fill.given ;
  (* hierconn *) wire [P+F+L+3:0]   \dut.lines.given ;
  (* hierconn *) wire [31:0]        \dut.lookup.kind ;
  (* hierconn *) wire [31:0]        \dut.fill.kind ;
  (* hierconn *) wire [23:0]        \dut.lines.kind ;
  // Strips of the window in front that were taken.
  (* hierconn *) wire [2:0]         \dut.filled ;
  wire          whole = \dut.filled == missed;
  wire          take = waits && !whole && offered;
  logic         was = 1'b0;
  logic [2:0]   next;
  always @(posedge clk) begin
    was <= 1'b1;
    next <= !rst_n || (waits && whole && reads) ? 3'd0 : \dut.filled + 3'(take);
  end
  always @* begin
    assert (\dut.lookup.given == {rst_n, flush, spoiled, in_valid, in_address, in_plane, in_section, in_strips_x, in_width, in_height, in_x, in_y, in_extra_x,
                                  in_extra_y, asked, room});
    assert (\dut.waiting.given == {rst_n, found_valid, whole && reads, found, found_missed});
    assert (\dut.fill.given == {rst_n, ask, ask_address, ask_place, take, request_ready, data_valid, data, data_last, data_error});
    assert (\dut.lines.given == {rst_n, take, place, lines, waits && whole, front, out_ready});
    assert (\dut.lookup.kind == {16'(STRIPS), 8'(SECTIONS), 8'd2} && \dut.fill.kind == {8'(P), 8'd2, 8'd14, 8'd64});
    assert (\dut.lines.kind == {8'(P - 2), 8'd2, 8'd14});
    assert ({in_ready, out_valid, out_error, out_window} == {taken, leaves, error, window});
    assert ({request_valid, request_address, request_beats} == {requests, address, beats});
    if (was) assert (\dut.filled == next);
  end
endmodule
