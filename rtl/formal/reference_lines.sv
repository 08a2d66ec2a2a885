// A window is read when it comes, from the memory of each block's row parity and line of the strip, at the place of the block's strip; with any stalls it
// leaves in order, each sample that of the block, row and column selected, with the first error of the blocks touched, row by row. `spoiled` says once
// for each window whether one of these is bus_error. A strip's lines are written into their memories. Memories give anything.
// BLOCK_LOG2 = 2, samples of 14 bits, 16 strips to a bank.
//
// Clauses: DEC-7
// Engine: bmc 2
// Cut: ram
// Complete: any step.
// Fault: hmlfc_reference_lines.sv / column_1 + COLUMN_BITS'(c) / column_1 ^ COLUMN_BITS'(c)
// Fault: hmlfc_reference_lines.sv / error_below != 0 ? error_below : error_corner / error_corner != 0 ? error_corner : error_below
// Fault: hmlfc_reference_lines.sv / COLUMN_BITS'(c) >= left_column / COLUMN_BITS'(c) > left_column
// Fault: hmlfc_reference_lines.sv / spoiled = valid[2] && advance / spoiled = valid[2]
// Fault: hmlfc_reference_lines.sv / write_at = write_place[PLACE_BITS:0] / write_at = write_place[PLACE_BITS+1:1]
`include "hmlfc_tables.svh"

module prove_reference_lines #(
  parameter integer PLACE_BITS = 4
) (
  input logic clk, input logic rst_n, input logic write, input logic [PLACE_BITS+1:0] write_place, input logic [4*230-1:0] write_lines,
  input logic in_valid, input logic [12:0] in_block_x, input logic [12:0] in_block_y, input logic in_two_x, input logic in_two_y,
  input logic [14:0] in_select_x, input logic [14:0] in_select_y, input logic [4*PLACE_BITS-1:0] in_places, input logic out_ready
);
  localparam integer P = PLACE_BITS + 1;  // bits of a line's place in its memory
  localparam integer L = 6 + 16 * 14;     // of a line: {error, samples}
  logic         in_ready, out_valid, spoiled;
  logic [5:0]   out_error;
  logic [349:0] out_window;
  hmlfc_reference_lines #(.BLOCK_LOG2(2), .SAMPLE_BITS(14), .PLACE_BITS(PLACE_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .write(write), .write_place(write_place), .write_lines(write_lines), .in_valid(in_valid), .in_ready(in_ready),
    .in_block_x(in_block_x), .in_block_y(in_block_y), .in_two_x(in_two_x), .in_two_y(in_two_y), .in_select_x(in_select_x), .in_select_y(in_select_y),
    .in_places(in_places), .out_valid(out_valid), .out_ready(out_ready), .out_error(out_error), .out_window(out_window), .spoiled(spoiled));

  // The memories {row parity, line of the strip}: what they are told, and their words.
  wire [7:0]     writes, reads;
  wire [8*P-1:0] write_at, read_at;
  wire [8*L-1:0] written, words;
`define MEMORY(k, a, b, c, d, e, f) \
  (* hierconn *) wire a , b ; (* hierconn *) wire [P-1:0] c , d ; (* hierconn *) wire [L-1:0] e , f ; \
  assign {writes[k], reads[k], write_at[k*P+:P], read_at[k*P+:P], written[k*L+:L], words[k*L+:L]} = {a , b , c , d , e , f };
  `MEMORY(0, \dut.g_row[0].g_column[0].memory.write , \dut.g_row[0].g_column[0].memory.read , \dut.g_row[0].g_column[0].memory.write_address ,
          \dut.g_row[0].g_column[0].memory.read_address , \dut.g_row[0].g_column[0].memory.write_data , \dut.g_row[0].g_column[0].memory.read_data )
  `MEMORY(1, \dut.g_row[0].g_column[1].memory.write , \dut.g_row[0].g_column[1].memory.read , \dut.g_row[0].g_column[1].memory.write_address ,
          \dut.g_row[0].g_column[1].memory.read_address , \dut.g_row[0].g_column[1].memory.write_data , \dut.g_row[0].g_column[1].memory.read_data )
  `MEMORY(2, \dut.g_row[0].g_column[2].memory.write , \dut.g_row[0].g_column[2].memory.read , \dut.g_row[0].g_column[2].memory.write_address ,
          \dut.g_row[0].g_column[2].memory.read_address , \dut.g_row[0].g_column[2].memory.write_data , \dut.g_row[0].g_column[2].memory.read_data )
  `MEMORY(3, \dut.g_row[0].g_column[3].memory.write , \dut.g_row[0].g_column[3].memory.read , \dut.g_row[0].g_column[3].memory.write_address ,
          \dut.g_row[0].g_column[3].memory.read_address , \dut.g_row[0].g_column[3].memory.write_data , \dut.g_row[0].g_column[3].memory.read_data )
  `MEMORY(4, \dut.g_row[1].g_column[0].memory.write , \dut.g_row[1].g_column[0].memory.read , \dut.g_row[1].g_column[0].memory.write_address ,
          \dut.g_row[1].g_column[0].memory.read_address , \dut.g_row[1].g_column[0].memory.write_data , \dut.g_row[1].g_column[0].memory.read_data )
  `MEMORY(5, \dut.g_row[1].g_column[1].memory.write , \dut.g_row[1].g_column[1].memory.read , \dut.g_row[1].g_column[1].memory.write_address ,
          \dut.g_row[1].g_column[1].memory.read_address , \dut.g_row[1].g_column[1].memory.write_data , \dut.g_row[1].g_column[1].memory.read_data )
  `MEMORY(6, \dut.g_row[1].g_column[2].memory.write , \dut.g_row[1].g_column[2].memory.read , \dut.g_row[1].g_column[2].memory.write_address ,
          \dut.g_row[1].g_column[2].memory.read_address , \dut.g_row[1].g_column[2].memory.write_data , \dut.g_row[1].g_column[2].memory.read_data )
  `MEMORY(7, \dut.g_row[1].g_column[3].memory.write , \dut.g_row[1].g_column[3].memory.read , \dut.g_row[1].g_column[3].memory.write_address ,
          \dut.g_row[1].g_column[3].memory.read_address , \dut.g_row[1].g_column[3].memory.write_data , \dut.g_row[1].g_column[3].memory.read_data )

  // The block {below, right} of the window that comes.
  function automatic [12:0] row_of(input [1:0] block);
    row_of = in_block_y + 13'(block[1]);
  endfunction
  function automatic [12:0] column_of(input [1:0] block);
    column_of = in_block_x + 13'(block[0]);
  endfunction

  (* anyconst *) logic [1:0] block;
  (* anyconst *) logic [2:0] memory;
  logic         was = 1'b0;
  logic [3:1]   valid;
  logic [1:0]   column;
  logic         row;
  logic [31:0]  entry_1, entry_2;        // {two_x, two_y, select_x, select_y}
  logic [4*L-1:0] lines, chosen;
  logic [5:0]   error;
  logic [349:0] window;
  // The pipeline: where the words of a window come from, what they are, what is to do with them.
  (* hierconn *) wire [3:1] \dut.valid ;
  (* hierconn *) wire [1:0] \dut.column_1 ;
  (* hierconn *) wire \dut.row_1 , \dut.two_x_1 , \dut.two_y_1 , \dut.two_x_2 , \dut.two_y_2 ;
  (* hierconn *) wire [14:0] \dut.select_x_1 , \dut.select_y_1 , \dut.select_x_2 , \dut.select_y_2 ;
  (* hierconn *) wire [4*L-1:0] \dut.blocks_next , \dut.blocks_2 ;
  wire          moves = !\dut.valid [3] || out_ready;
  wire          two_x = \dut.two_x_2 , two_y = \dut.two_y_2 ;
  wire [3:0]    touched = {two_x && two_y, two_y, two_x, 1'b1};
  wire [4*L-1:0] blocks = \dut.blocks_2 ;
  logic [5:0]   first;
  logic         bus_error;
  // Samples of the rows that are selected, then of the columns.
  (* hierconn *) wire [559:0] \dut.rows ;
  (* hierconn *) wire [349:0] \dut.window ;
  logic [559:0] rows;
  logic [349:0] samples;
  always @* begin
    first = 6'd0;
    bus_error = 1'b0;
    for (integer b = 3; b >= 0; b = b - 1) begin
      if (touched[b] && blocks[L*b+224 +: 6] != 0) first = blocks[L*b+224 +: 6];
      if (touched[b] && blocks[L*b+224 +: 6] == HMLFC_ERROR_BUS_ERROR) bus_error = 1'b1;
    end
  end
  always @* begin
    rows = 0;
    chosen = 0;
    for (integer b = 0; b < 4; b = b + 1)
      for (integer k = 0; k < 8; k = k + 1)
        chosen[L*b +: L] = chosen[L*b +: L] | words[L*k +: L] & {L{{\dut.row_1 ^ 1'(b/2), \dut.column_1 + 2'(b%2)} == 3'(k)}};
    samples = 0;
    for (integer j = 0; j < 5; j = j + 1) begin
      for (integer y = 0; y < 8; y = y + 1)
        for (integer x = 0; x < 8; x = x + 1)
          rows[112*j + 14*x +: 14] = rows[112*j + 14*x +: 14] | blocks[L*(y/4*2 + x/4) + 14*(y%4*4 + x%4) +: 14] &
              {14{\dut.select_y_2 [3*j +: 3] == 3'(y)}};
      for (integer i = 0; i < 5; i = i + 1)
        for (integer x = 0; x < 8; x = x + 1)
          samples[14*(5*j+i) +: 14] = samples[14*(5*j+i) +: 14] | \dut.rows [112*j + 14*x +: 14] & {14{\dut.select_x_2 [3*i +: 3] == 3'(x)}};
    end
  end
  always @(posedge clk) begin
    was <= 1'b1;
    valid <= !rst_n ? 3'd0 : moves ? {\dut.valid [2:1], in_valid} : \dut.valid ;
    {row, column} <= moves ? {in_block_y[0], in_block_x[1:0]} : {\dut.row_1 , \dut.column_1 };
    entry_1 <= moves ? {in_two_x, in_two_y, in_select_x, in_select_y} : {\dut.two_x_1 , \dut.two_y_1 , \dut.select_x_1 , \dut.select_y_1 };
    entry_2 <= moves ? {\dut.two_x_1 , \dut.two_y_1 , \dut.select_x_1 , \dut.select_y_1 } : {two_x, two_y, \dut.select_x_2 , \dut.select_y_2 };
    lines <= moves ? \dut.blocks_next : blocks;
    error <= moves ? first : out_error;
    window <= moves ? \dut.window : out_window;
  end
  always @* begin
    if (!was) begin
      assert (in_ready == moves && out_valid == \dut.valid [3] && spoiled == (\dut.valid [2] && moves && bus_error));
      assert (\dut.blocks_next == chosen && \dut.rows == rows && \dut.window == samples);
      assert (reads == {8{moves}});
      if (in_valid && memory == {1'(row_of(block)), 2'(column_of(block))})
        assert (read_at[P*memory +: P] == {1'(column_of(block) >> 2), in_places[PLACE_BITS*{1'(row_of(block)), 1'(column_of(block) >> 2)} +: PLACE_BITS]});
      assert (writes == (write ? write_place[PLACE_BITS+1] ? 8'hf0 : 8'h0f : 8'h00));
      if (write) assert (write_at == {8{write_place[PLACE_BITS:0]}} && written == {2{write_lines}});
    end else begin
      assert (\dut.valid == valid && {\dut.row_1 , \dut.column_1 } == {row, column});
      assert ({\dut.two_x_1 , \dut.two_y_1 , \dut.select_x_1 , \dut.select_y_1 } == entry_1);
      assert ({two_x, two_y, \dut.select_x_2 , \dut.select_y_2 } == entry_2);
      assert (blocks == lines);
      assert (out_error == error && out_window == window);
    end
  end
endmodule
