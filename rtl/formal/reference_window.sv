// A step from any state: each coordinate of the window is clamped to the plane, that of the last column or row, where this has weight 0, is that of the one
// before; a clock with advance later the first block, whether the last sample lies in another one, and where each sample lies are those of the
// coordinates. Without advance nothing changes. BLOCK_LOG2 = 2.
//
// Clauses: DEC-5, MOT-9
// Engine: bmc 2
// Complete: any step.
// Fault: hmlfc_reference_window.sv / (i == SIDE - 1 && !extra_y) ? i - 1 : i / i
// Fault: hmlfc_reference_window.sv / at[15:0] >= {1'b0, size} / at[15:0] > {1'b0, size}
// Fault: hmlfc_reference_window.sv / two_y <= BLOCK_BITS'(rows / two_y <= BLOCK_BITS'(columns
module prove_reference_window (
  input logic clk, input logic advance, input logic signed [16:0] x, input logic signed [16:0] y, input logic extra_x, input logic extra_y,
  input logic [14:0] width, input logic [14:0] height
);
  logic [12:0]  block_x, block_y;
  logic         two_x, two_y;
  logic [14:0]  select_x, select_y;
  hmlfc_reference_window #(.BLOCK_LOG2(2)) dut (
    .clk(clk), .advance(advance), .x(x), .y(y), .extra_x(extra_x), .extra_y(extra_y), .width(width), .height(height), .block_x(block_x),
    .block_y(block_y), .two_x(two_x), .two_y(two_y), .select_x(select_x), .select_y(select_y));
  (* hierconn *) wire [74:0] \dut.columns , \dut.rows ;
  function automatic [14:0] clamp(input signed [18:0] at, input [14:0] size);
    clamp = at < 0 ? 15'd0 : at > $signed({4'd0, size}) - 19'sd1 ? size - 15'd1 : at[14:0];
  endfunction
  function automatic [28:0] blocks_of(input [74:0] at);  // {first block, two, places}
    blocks_of[28:16] = at[14:2];
    blocks_of[15] = at[74:62] != at[14:2];
    for (integer i = 0; i < 5; i = i + 1) blocks_of[3*i +: 3] = {at[15*i+2 +: 13] != at[14:2], at[15*i +: 2]};
  endfunction
  logic         was = 1'b0;
  logic [74:0]  columns, rows;
  logic [28:0]  across, down;
  always @(posedge clk) begin
    was <= 1'b1;
    for (integer i = 0; i < 5; i = i + 1) begin
      columns[15*i +: 15] <= clamp(19'(x) + 19'($signed(i == 4 && !extra_x ? 3 : i)), width);
      rows[15*i +: 15] <= clamp(19'(y) + 19'($signed(i == 4 && !extra_y ? 3 : i)), height);
    end
    {across, down} <= {blocks_of(\dut.columns ), blocks_of(\dut.rows )};
    if (!advance) {columns, rows, across, down} <= {\dut.columns , \dut.rows , block_x, two_x, select_x, block_y, two_y, select_y};
  end
  always @* begin
    assume (width != 0 && width <= 16384 && height != 0 && height <= 16384);
    // Corners of windows: blocks of the plane, moved by less than 128 samples (MOT-8).
    assume (x >= -17'sd256 && x < 17'sd16640 && y >= -17'sd256 && y < 17'sd16640);
    if (was) begin
      assert (\dut.columns == columns && \dut.rows == rows);
      assert ({block_x, two_x, select_x} == across);
      assert ({block_y, two_y, select_y} == down);
    end
  end
endmodule
