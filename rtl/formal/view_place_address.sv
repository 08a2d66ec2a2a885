// The address of a place, with any stalls: its macro row's address, the bytes of the rows of blocks above it there, and of the blocks to its
// left. Pitches are powers of two: for them the bytes of rows are a shift, which is not how the module adds them.
//
// Clauses: Descriptors (docs/view_unit.md)
// Engine: bmc 4
// Complete: the clocks from a position to its place, with a stall. What a macro row's address is, and other pitches to it, is proved in view_place.
// Cover: 4
// Fault: hmlfc_view_place.sv / from_left_1 <= bx - / from_left_1 <= bx[7:0] -
// Fault: hmlfc_view_place.sv / by[3] ? {1'b0, row_bytes, 1'b0} / by[3] ? {2'd0, row_bytes}
// Fault: hmlfc_view_place.sv / rows_high_1 <= by[4] ? {row_bytes, 4'd0} / rows_high_1 <= by[4] ? {row_bytes[22:0], 4'd0}
// Fault: hmlfc_view_place.sv / base_1 <= macro_address / base_1 <= view.destination
// Fault: hmlfc_view_place.sv / {1'b0, from_left_1, 2'd0} + {2'd0, from_left_1, 1'b0} / {1'b0, from_left_1, 2'd0}
module prove_view_place_address #(
  parameter integer BLOCK_LOG2 = 1
) (input logic clk, input logic rst_n, input logic start, input logic place_ready);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  localparam integer N = hmlfc_pkg::BLOCK_BITS;
  localparam integer R = 24 + BLOCK_LOG2;
  (* anyconst *) hmlfc_pkg::view_t view;
  (* anyconst *) logic [4:0] pitch_log2;
  hmlfc_pkg::place_t place;
  logic place_valid;
  hmlfc_view_place #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .rst_n(rst_n), .start(start), .view(view), .done(), .place_valid(place_valid), .place_ready(place_ready), .place(place));
  (* hierconn *) wire         \dut.starting ;
  (* hierconn *) wire         \dut.scan_valid ;
  (* hierconn *) wire [R+4:0] \dut.weight ;
  (* hierconn *) wire [A-1:0] \dut.macro_address ;
  (* hierconn *) wire [N-1:0] \dut.bx ;
  (* hierconn *) wire [N-1:0] \dut.by ;
  wire go = !place_valid || place_ready;

  // The address of the position at which the scan is.
  wire [N-1:0] blocks_left = \dut.bx - view.blocks.first_x;
  wire [A-1:0] left = A'(blocks_left);
  wire [A-1:0] above = A'(\dut.by [4:0]);
  logic [A-1:0] pixels;  // bytes of a row of them, as many as blocks to the left
  always @*
    case (view.format)
      hmlfc_pkg::FORMAT_RGB888: pixels = left + (left << 1);
      hmlfc_pkg::FORMAT_RGB101010: pixels = left << 2;
      hmlfc_pkg::FORMAT_RGB161616: pixels = (left << 1) + (left << 2);
      default: pixels = left << 1;
    endcase
  wire [A-1:0] now = \dut.macro_address + (above << (pitch_log2 + BLOCK_LOG2)) + (pixels << BLOCK_LOG2);

  logic [A-1:0] now_1, now_2, now_3;
  logic [2:0]   filled = 3'd0;  // places that have come from `now`
  always @(posedge clk) if (go) {now_3, now_2, now_1, filled} <= {now_2, now_1, now, filled[1:0], !\dut.starting && \dut.scan_valid };
  always @* begin
    assume (pitch_log2 < 24 && view.pitch == 24'd1 << pitch_log2);
    // As proved in view_place: a scan has a row of blocks as its weight.
    if (!\dut.starting && \dut.scan_valid ) assume (\dut.weight == {view.pitch, BLOCK_LOG2'(0), 5'd0});
    if (filled[2] && place_valid) assert (place.address == now_3);
    cover (filled[2] && place_valid && place.address[A-1:24] != 0);
  end
endmodule
