// A block enters when its tile is loaded or it shares no disparity, and moves on by a stage in each clock in which the last is empty or leaves; else
// nothing changes. For one that shares a disparity the reader is asked, in stage 1, for the value of its grid block, row by row in the tile, by the
// head that was written last for the tile's context; the tile is given back in stage 3, when the bits are there. It leaves with that value plus the
// least disparity of the tile, or with the first error: its own, the head's, or vector_range; all else as it came. Of a head with an error the error
// counts alone; of one with level code 0, as of empty tiles, the code and the least disparity. CONTEXTS = 4, CONTEXT_WORDS = 256, WINDOW_BITS = 128.
//
// Clauses: MOT-6, MOT-10
// Engine: bmc 4
// Cover: 4
// Cut: element_reader
// Complete: one step of six stages with anything in them; a block that enters after its head was written, and perhaps another.
// Fault: hmlfc_disparity_blocks.sv / 10'(in_y) * 10'(columns_0) + 10'(in_x) / 10'(in_x) * 10'(columns_0) + 10'(in_y)
// Fault: hmlfc_disparity_blocks.sv / disparity > MAX_DISPARITY / disparity > MAX_DISPARITY + 14'sd1
// Fault: hmlfc_disparity_blocks.sv / {leasts[4*13-1:0], least_0} / {leasts[3*13-1:0], least_0, least_0}
// Fault: hmlfc_disparity_blocks.sv / .advance, / .advance(1'b1),
// Fault: hmlfc_disparity_blocks.sv / valid[3] && flow_3.disparity_asked / flow_3.disparity_asked
// Fault: hmlfc_disparity_blocks.sv / if (head_write) begin / if (head_write || parsed_context == 2'd3) begin
// Fault: hmlfc_disparity_blocks.sv / flow_5.disparity_asked && flow_5.job.error == 0 / flow_5.disparity_asked
`include "hmlfc_tables.svh"
`include "inside.svh"
module prove_disparity_blocks (
  input logic clk, input logic rst_n, input logic [3:0] ready, input logic head_write, input logic [1:0] parsed_context, input logic [62:0] head,
  input logic [127:0] window, input logic in_valid, input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow, input logic [4:0] in_x, input logic [4:0] in_y,
  input logic out_ready
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  logic         release_valid, read_enable, in_ready, out_valid;
  logic [1:0]   release_context;
  logic [9:0]   read_word;
  logic [F-1:0] out_flow;
  hmlfc_disparity_blocks #(.CONTEXTS(4), .CONTEXT_WORDS(256), .WINDOW_BITS(128)) dut (
    .clk(clk), .rst_n(rst_n), .ready(ready), .release_valid(release_valid), .release_context(release_context), .head_write(head_write),
    .parsed_context(parsed_context), .head_error(head[62:57]), .head_least(head[56:44]), .head_columns(head[43:38]), .head_level_code(head[37:32]),
    .head_total(head[31:18]), .head_position(head[17:0]), .read_enable(read_enable), .read_word(read_word), .window(window), .in_valid(in_valid),
    .in_ready(in_ready), .in_flow(in_flow), .in_x(in_x), .in_y(in_y), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow));

  `SEEN(6, \dut.valid )
  `SEEN(6*F, \dut.flows )
  `SEEN(65, \dut.leasts )
  `SEEN(6, \dut.error_1 )
  `SEEN(6, \dut.columns_0 )
  `SEEN(1, \dut.reader.advance )
  `SEEN(16, \dut.reader.position )
  `SEEN(14, \dut.reader.total )
  `SEEN(6, \dut.reader.level_code )
  `SEEN(10, \dut.reader.index )
  `SEEN(10, \dut.reader.value )
  `SEEN(1, \dut.reader.read_enable )
  `SEEN(10, \dut.reader.read_word )
  `SEEN(128, \dut.reader.window )

  // Any context: what was written there last, in an earlier clock.
  (* anyconst *) logic [1:0] one;
  logic        known = 1'b0;
  logic [62:0] of_one;
  wire [5:0]   error = of_one[62:57], columns = of_one[43:38], code = of_one[37:32];
  always @(posedge clk) if (head_write && parsed_context == one) {known, of_one} <= {1'b1, head};

  // The block that enters, and those of the stages whose logic looks at them.
  hmlfc_pkg::flow_t enters, at_1, at_3, at_5, leaves_1, leaves_5;
  assign enters = in_flow;
  assign at_1 = \dut.flows [0 +: F];
  assign at_3 = \dut.flows [2*F +: F];
  assign at_5 = \dut.flows [4*F +: F];
  wire        advance = !\dut.valid [5] || out_ready;
  wire        sees = known && enters.disparity_asked && enters.disparity_context == one;
  wire [14:0] sum = {{2{\dut.leasts [64]}}, \dut.leasts [64:52]} + {5'd0, \dut.reader.value };
  always @* begin
    leaves_1 = at_1;
    if (at_1.disparity_asked && at_1.job.error == 0) leaves_1.job.error = \dut.error_1 ;
    leaves_5 = at_5;
    if (at_5.disparity_asked && at_5.job.error == 0) begin
      leaves_5.disparity = sum[12:0];
      if ($signed(sum) > 4095) leaves_5.job.error = HMLFC_ERROR_VECTOR_RANGE;
    end
  end

  // What stages 1 to 6 hold after a clock: after the first, from any state; of a block that has just entered with a head, after the third.
  // In stage 1, what is asked for: the head's error and code, and what counts with neither 0.
  logic [1:0]     clocks = 2'd0;
  logic           held, entered;
  logic [5:0]     valid;
  logic [6*F-1:0] flows;
  logic [64:0]    leasts;
  logic [11:0]    first;
  logic [39:0]    asked;
  wire [11:0]     firsts = {\dut.error_1 , \dut.reader.level_code };
  wire [39:0]     asks = {\dut.reader.position , \dut.reader.total , \dut.reader.index };
  always @(posedge clk) begin
    if (clocks != 3) clocks <= clocks + 2'd1;
    valid <= !rst_n ? 6'd0 : advance ? {\dut.valid [4:0], in_valid && in_ready} : \dut.valid ;
    flows <= advance ? {leaves_5, \dut.flows [F +: 3*F], leaves_1, in_flow} : \dut.flows ;
    leasts <= advance ? {\dut.leasts [51:0], of_one[56:44]} : \dut.leasts ;
    first <= advance ? {error, code} : firsts;
    asked <= advance ? {one, of_one[13:0], of_one[31:18], 10'(in_y) * 10'(\dut.columns_0 ) + 10'(in_x)} : asks;
    {held, entered} <= {!advance, advance && sees};
  end

  generate
    for (genvar k = 0; k < 6; k = k + 1) begin : stage  // k + 1; in a flow: bit 48 disparity_asked, bits 63 to 58 the error, 12 to 0 the disparity
      wire [F-1:0] is = \dut.flows [k*F +: F];
      wire [F-1:0] was = flows[k*F +: F];
      wire shares = valid[k] && was[48] && was[63:58] == 0;
      always @* begin
        if (clocks == 0) assume (is[63:58] <= HMLFC_ERROR_BUS_ERROR);
        if (clocks == 1 && valid[k]) begin
          assert (is[F-1:13] == was[F-1:13]);
          if (!was[48] || (k == 5 && shares)) assert (is[12:0] == was[12:0]);
        end
      end
      if (k == 0) begin : asks_reader
        always @* if (shares && (clocks == 1 ? held : clocks == 3 && entered)) begin
          assert (firsts[11:6] == first[11:6]);
          if (first[11:6] == 0) assert (firsts[5:0] == first[5:0] && \dut.leasts [12:0] == leasts[12:0]);
          if (first[11:6] == 0 && first[5:0] != 0) assert (asks == asked);
          cover (clocks == 3 && first == 12'd27 && asked[9:0] > 10'd992 && asked[38]);
        end
      end else if (k < 5) begin : has_least
        always @* if (clocks == 1 && shares) assert (\dut.leasts [13*k +: 13] == leasts[13*k +: 13]);
      end else begin : leaves
        always @* if (clocks == 1 && valid[k] && was[48] && !held) begin
          cover (is[63:58] == HMLFC_ERROR_VECTOR_RANGE);
          cover (shares && is[12:0] == 13'd4095);
        end
      end
    end
  endgenerate

  always @* begin
    // Legal: errors of the specification, a head as the parser makes it, a place in the tile's columns; no tile that is ready is written.
    assume (enters.job.error <= HMLFC_ERROR_BUS_ERROR && head[62:57] <= HMLFC_ERROR_BUS_ERROR && !(head_write && ready[parsed_context]));
    if (clocks == 0) assume (firsts[11:6] <= HMLFC_ERROR_BUS_ERROR && firsts[5:0] <= 27 && asks[37:24] <= 81 && asks[23:10] <= 10240);
    if (head[62:57] == 0 && head[37:32] != 0) assume (head[43:38] >= 1 && head[43:38] <= 32 && head[37:32] <= 27 && head[31:18] <= 10240 && head[17:0] <= 81);
    if (sees && error == 0 && code != 0) assume (in_x < columns);

    if (clocks == 0) begin
      assert (\dut.reader.advance == advance && read_enable == \dut.reader.read_enable && \dut.reader.window [126:0] == window[126:0]);
      if (read_enable) assert (read_word == \dut.reader.read_word );
      if (in_valid) assert (in_ready == (advance && (!enters.disparity_asked || ready[enters.disparity_context])));
      assert (release_valid == (advance && \dut.valid [2] && at_3.disparity_asked));
      if (release_valid) assert (release_context == at_3.disparity_context);
      assert (out_valid == \dut.valid [5]);
      if (out_valid) assert (out_flow == \dut.flows [5*F +: F]);
    end
    if (clocks == 1) assert (\dut.valid == valid);
    if (clocks == 2 && in_valid && sees && error == 0 && code != 0) assert (\dut.columns_0 == columns);
  end
endmodule
