// The head's fields for block headers: the first error in them, each field's end before its value (TIL-8), and how many
// bits they take; after them, with headers as wide as they say, the headers overrun the record just where the last one
// ends behind it. That the fields of steps end behind it (STP-1) may show as that. An entry is written two clocks after
// its header was asked for, none across a reset. Records of fewer than 2^18 - 2048 bits. BLOCK_LOG2 = 2, SKEW_BITS = 6.
//
// Clauses: TIL-8, STP-1
// Engine: bmc 4
// Complete: `start` writes all that the headers' width depends on.
module prove_tile_headers #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer SKEW_BITS = 6
) (
  input logic clk, input logic [6:0] count, input logic [3:0] depth, input logic steps,
      input logic [SKEW_BITS-1:0] skew, input logic [17:0] bits,
  input logic [31:0] field, input logic [17:0] position, input logic start, input logic active, input logic rst_n
);
  logic [5:0] shared_error;
  logic [4:0] shared_bits, header_bits;
  logic       overrun, pending, entry_write;
  hmlfc_tile_headers #(.BLOCK_LOG2(BLOCK_LOG2), .SKEW_BITS(SKEW_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .count(count), .depth(depth), .steps(steps), .skew(skew), .bits(bits), .field(field),
    .position(position), .start(start), .shared_error(shared_error), .shared_bits(shared_bits), .active(active),
    .header_bits(header_bits), .overrun(overrun), .last(), .pending(pending), .entry_write(entry_write),
    .entry_number(), .entry_data());

  localparam logic [5:0] TILE_OVERRUN = 6'd19, BAD_MODE = 6'd21;
  wire integer left = bits - position;  // of the record, from the fields on
  wire [2:0] level_bits = field >> 6;   // behind level_base
  wire [3:0] bias_bits = field >> 9;
  wire [1:0] step_bits = field >> 17;   // behind step_base
  wire [5:0] first_error = left < 9 ? TILE_OVERRUN : level_bits > 6 ? BAD_MODE : left < 13 ? TILE_OVERRUN :
      bias_bits > depth + 2 ? BAD_MODE : 6'd0;

  // From when the fields were taken to the first header.
  logic       first = 1'b0;
  logic [1:0] listed, clocks = 2'd0;  // headers of the last two clocks that are still to be written
  logic [5:0] width;
  wire integer end_of_headers = position + count * width;
  always @(posedge clk) begin
    first <= start || (first && !active);
    listed <= rst_n ? {listed[0], active && !overrun} : 2'd0;
    if (clocks != 2) clocks <= clocks + 2'd1;
    if (start) width <= level_bits + bias_bits + (steps ? step_bits : 0);
  end
  always @* begin
    assume (depth >= 8 && depth <= 12 && count >= 1 && count <= 64 && bits < 18'h3F800 && position <= bits + 32 &&
        !(start && active));
    if (position <= bits) assert (shared_error == first_error);
    assert (shared_bits == (steps ? 19 : 13));
    if (first) assert (header_bits == width);
    if (first && active) assert (overrun == (end_of_headers > bits));
    if (clocks == 2) assert (pending == listed[0] && entry_write == listed[1]);
  end
endmodule
