// Two clocks after `start` the components are placed: the horizontal ones at `position`, the vertical ones behind them, `next` behind these, until the
// next start. Their readers are asked for vector after vector; each is written four clocks after it was asked for, as least components plus values, with
// its sign, or as one outside the window. `last` is with the last write. WORD_BITS = 10, PLACE_BITS = 15, WINDOW_BITS = 512.
//
// Clauses: TIL-6, TIL-7
// Engine: bmc 6
// Cut: element_reader bise_bits
// Complete: one step of the walk, from any vector, with what is asked for in four clocks.
// Fault: hmlfc_tile_vectors.sv / wire signed [9:0] dx = 10'(min_x) / wire signed [8:0] dx = 9'(min_x)
// Fault: hmlfc_tile_vectors.sv / y_position + POSITION_BITS'(bits_y) / y_position + POSITION_BITS'(bits_x)
// Fault: hmlfc_tile_vectors.sv / count + 7'd3 / count + 7'd2
// Fault: hmlfc_tile_vectors.sv / active && number < count / number < count
`define IS(width, a, b) (* hierconn *) wire [width-1:0] b ; always @* assert (a == b );
module prove_tile_vectors (
  input logic clk, input logic rst_n, input logic signed [8:0] min_x, input logic signed [8:0] min_y, input logic [63:0] signs,
  input logic [17:0] position, input logic start, input logic active, input logic [1023:0] window
);
  (* anyconst *) logic [6:0] count;
  (* anyconst *) logic [5:0] codes_x;
  (* anyconst *) logic [5:0] codes_y;
  (* anyconst *) logic [6:0] search_window;
  (* anyconst *) logic context_number;
  (* anyconst *) logic [14:0] skew;
  (* anyconst *) logic [13:0] length_x;
  (* anyconst *) logic [13:0] length_y;
  logic        placed, last, vector_write;
  logic [17:0] next, vector_data;
  logic [1:0]  read_enable;
  logic [19:0] read_word;
  logic [5:0]  vector_number;
  hmlfc_tile_vectors #(.WORD_BITS(10), .PLACE_BITS(15), .WINDOW_BITS(512)) dut (
    .clk(clk), .rst_n(rst_n), .count(count), .min_x(min_x), .min_y(min_y), .codes_x(codes_x), .codes_y(codes_y), .signs(signs),
    .search_window(search_window), .position(position), .start(start), .placed(placed), .next(next), .context_number(context_number), .skew(skew),
    .active(active), .last(last), .read_enable(read_enable), .read_word(read_word), .window(window), .vector_write(vector_write),
    .vector_number(vector_number), .vector_data(vector_data));

  // What is read: a reader uses the 127 bits from which it may take 64.
  `IS(11, count, \dut.size_x.count )
  `IS(11, count, \dut.size_y.count )
  `IS(6, codes_x, \dut.size_x.level_code )
  `IS(6, codes_y, \dut.size_y.level_code )
  `IS(6, codes_x, \dut.reader_x.level_code )
  `IS(6, codes_y, \dut.reader_y.level_code )
  `IS(1, 1'b1, \dut.reader_x.advance )
  `IS(1, 1'b1, \dut.reader_y.advance )
  `IS(14, length_x, \dut.reader_x.total )
  `IS(14, length_y, \dut.reader_y.total )
  `IS(1, read_enable[0], \dut.reader_x.read_enable )
  `IS(1, read_enable[1], \dut.reader_y.read_enable )
  `IS(10, read_word[9:0], \dut.reader_x.read_word )
  `IS(10, read_word[19:10], \dut.reader_y.read_word )
  (* hierconn *) wire [511:0] \dut.reader_x.window ;
  (* hierconn *) wire [511:0] \dut.reader_y.window ;
  (* hierconn *) wire [13:0] \dut.size_x.bits ;
  (* hierconn *) wire [13:0] \dut.size_y.bits ;
  (* hierconn *) wire [15:0] \dut.reader_x.position ;
  (* hierconn *) wire [15:0] \dut.reader_y.position ;
  (* hierconn *) wire [9:0] \dut.reader_x.index ;
  (* hierconn *) wire [9:0] \dut.reader_y.index ;
  (* hierconn *) wire [7:0] \dut.reader_x.value ;
  (* hierconn *) wire [7:0] \dut.reader_y.value ;

  // Clocks since a start; the vector that is asked for, and those of the last four clocks.
  logic [1:0]  age;
  logic        begun = 1'b0, known = 1'b0, was_active, ends;
  logic [17:0] from;
  wire [17:0]  behind_x = from + length_x;
  wire [17:0]  behind_y = behind_x + length_y;
  logic [6:0]  number;
  logic [2:0]  clocks = 3'd0;
  logic [3:0]  asked;
  logic [23:0] numbers;
  wire integer x = min_x + $signed({24'd0, \dut.reader_x.value });
  wire integer y = min_y + $signed({24'd0, \dut.reader_y.value });
  wire integer w = search_window;
  always @(posedge clk) begin
    age <= rst_n ? {age[0], start} : 2'd0;
    was_active <= active;
    ends <= !rst_n || (active && number == count + 7'd3);
    begun <= begun || start;
    known <= !start && (known || (age[0] && begun));
    if (start) from <= position;
    number <= start ? 7'd0 : active ? number + 7'd1 : number;
    if (clocks != 4) clocks <= clocks + 3'd1;
    asked <= rst_n ? {asked[2:0], active && number < count} : 4'd0;
    numbers <= {numbers[17:0], number[5:0]};
  end
  always @* begin
    assume (count >= 1 && count <= 64 && min_x >= -w && min_x <= w && min_y >= -w && min_y <= w);
    assume (\dut.size_x.bits == length_x && \dut.size_y.bits == length_y);
    assume (!(start && (active || age != 0)));
    if (clocks == 0) assume (number == \dut.reader_x.index );
    else assume (ends ? !active : active == was_active || (active && number == 0));  // from the first vector to the last write
    assert (\dut.reader_x.window [126:0] == window[126:0] && \dut.reader_y.window [126:0] == window[638:512]);
    assert (\dut.reader_x.index == number && \dut.reader_y.index == number);
    if (begun) assert (\dut.reader_x.position == {context_number, 15'(from + skew)});
    if (known) assert (\dut.reader_y.position == {context_number, 15'(behind_x + skew)} && next == behind_y);
    if (clocks >= 2) assert (placed == age[1]);
    if (clocks == 4) begin
      assert (vector_write == asked[3]);
      if (active) assert (last == (vector_write && vector_number == count - 1));
    end
    if (clocks == 4 && vector_write) begin
      assert (vector_number == numbers[23:18]);
      assert (vector_data[17] == (x > w || y > w));
      if (x <= w && y <= w) assert (vector_data[16:0] == {signs[vector_number], y[7:0], x[7:0]});
    end
  end
endmodule
