// Of an image's row or column: the group that it is in, this group's reference image, the neighbouring group of MOT-7 with its reference image, and
// the parent's place, for all grids; when they come, and that they hold.
//
// Clauses: STR-3, STR-4, EXT-3, MOT-7
// Engine: bmc 14
// Cover: 12
// Complete: one operation, whose inputs hold. Divisions (proof divide) end after 2 clocks in place of 11; of their quotients group is exact, begins of
// groups are any that go up and have the image in its group.
// Fault: hmlfc_group_axis.sv / 22'(groups) - 22'd1 / 22'(groups)
// Fault: hmlfc_group_axis.sv / at >= middles[11+:10] / at > middles[11+:10]
// Fault: hmlfc_group_axis.sv / > 22'(count) ? count : / > 22'(count) ? count - 11'd1 :
// Fault: hmlfc_group_axis.sv / up ? middles[22+:10] / up ? middles[11+:10]
// Fault: hmlfc_group_axis.sv / group == 0; / 1'b0;

// In the place of the divisions.
module hmlfc_divide #(parameter integer WIDTH = 1, parameter integer DIVISOR_BITS = 1, parameter integer QUOTIENT_BITS = 1) (
  input logic clk, input logic rst_n, input logic start, input logic [WIDTH-1:0] dividend, input logic [DIVISOR_BITS-1:0] divisor,
  output logic idle, output logic done, output logic [QUOTIENT_BITS-1:0] quotient
);
  (* anyseq *) logic [QUOTIENT_BITS-1:0] value;
  logic [1:0] left;
  logic [WIDTH-1:0] n;
  logic [DIVISOR_BITS-1:0] d;
  assign idle = left == 0;
  always @(posedge clk) begin
    done <= left == 1 && rst_n;
    if (start) {n, d} <= {dividend, divisor};
    if (left == 1) quotient <= value;
    left <= !rst_n ? 2'd0 : start ? 2'd2 : left - 2'(left != 0);
  end
endmodule

module prove_group_axis (input logic clk, input logic start);
  (* anyconst *) logic [9:0] at;
  (* anyconst *) logic [10:0] count;
  (* anyconst *) logic [7:0] size;
  (* anyconst *) logic [10:0] groups;
  (* anyconst *) logic balanced;
  (* anyconst *) logic [7:0] cluster;
  logic        started = 1'b0;
  logic        done;
  logic [10:0] group, next_group;
  logic [9:0]  reference_at, next_reference_at, parent;
  hmlfc_group_axis dut (
    .clk(clk), .rst_n(started), .start(start), .at(at), .count(count), .size(size), .groups(groups), .balanced(balanced), .cluster(cluster),
    .done(done), .group(group), .reference_at(reference_at), .next_group(next_group), .next_reference_at(next_reference_at), .parent(parent));
  (* hierconn *) wire \dut.g_divide[0].divide_one.done ;
  (* hierconn *) wire [10:0] \dut.g_divide[0].divide_one.quotient ;
  (* hierconn *) wire [10:0] \dut.g_divide[1].divide_one.quotient ;
  (* hierconn *) wire [10:0] \dut.g_divide[2].divide_one.quotient ;
  (* hierconn *) wire [10:0] \dut.g_divide[3].divide_one.quotient ;
  (* hierconn *) wire [21:0] \dut.g_divide[0].divide_one.n ;
  (* hierconn *) wire [21:0] \dut.g_divide[1].divide_one.n ;
  (* hierconn *) wire [21:0] \dut.g_divide[2].divide_one.n ;
  (* hierconn *) wire [21:0] \dut.g_divide[3].divide_one.n ;
  (* hierconn *) wire [10:0] \dut.g_divide[0].divide_one.d ;
  (* hierconn *) wire [10:0] \dut.g_divide[1].divide_one.d ;
  (* hierconn *) wire [10:0] \dut.g_divide[2].divide_one.d ;
  (* hierconn *) wire [10:0] \dut.g_divide[3].divide_one.d ;
  wire         divided = started && \dut.g_divide[0].divide_one.done ;

  // The row of groups that holds the image: EXT-3, STR-4; their begins times `groups` where they are balanced.
  logic [10:0] own;
  logic [9:0]  above;
  wire [10:0]  unit = balanced ? count : 11'(size);
  wire [21:0]  own_begin = 22'(group) * 22'(unit);
  wire [21:0]  place = balanced ? (22'(at) + 22'd1) * 22'(groups) - 22'd1 : 22'(at);
  // Begins of the groups from the one before it to the second after it. With groups of one size the last ends with the grid.
  logic [10:0] before, first, second, third;
  logic [4:0]  age = 5'd0;  // clocks since the start
  logic [1:0]  rounds;      // of divisions that are done
  always @(posedge clk) begin
    started <= 1'b1;
    if (start) {age, rounds} <= {5'd1, 2'd0};
    else if (age != 0 && age != 31) age <= age + 5'd1;
    if (divided) begin
      rounds <= rounds + 2'd1;
      if (rounds == 0) {above, own} <= {\dut.g_divide[0].divide_one.quotient [9:0], \dut.g_divide[1].divide_one.quotient };
      else {before, first, second, third} <= {\dut.g_divide[0].divide_one.quotient , \dut.g_divide[1].divide_one.quotient ,
                                              \dut.g_divide[2].divide_one.quotient , \dut.g_divide[3].divide_one.quotient };
    end
    if (!balanced) begin
      before <= 11'(own_begin - unit);
      first <= own_begin[10:0];
      second <= own_begin + unit > count ? count : 11'(own_begin + unit);
      third <= own_begin + 2 * unit > count ? count : 11'(own_begin + 2 * unit);
    end
  end
  wire [9:0] own_reference = 10'(first + ((second - first - 11'd1) >> 1));
  wire       goes_up = at >= own_reference;
  wire       is_above = own + 11'd1 < groups;
  wire       is_below = own != 0;
  wire       up = goes_up ? is_above : !is_below && is_above;
  wire       down = goes_up ? !is_above && is_below : is_below;
  wire       over = age >= (balanced ? 5'd11 : 5'd8);
  always @* begin
    assume (count >= 1 && count <= 1024 && at < count && size != 0 && cluster != 0 && groups <= count);
    if (!started || age != 0) assume (!start);
    if (started) assert (done == (age == (balanced ? 5'd11 : 5'd8)));
    if (age > 5) begin
      assume (own < groups && own_begin <= place && place < own_begin + unit && above <= at);
      if (!balanced) assume (is_above == (own_begin + unit < count));
    end
    if (rounds == 2) assume (first <= at && at < second && second <= count && (!is_below || before < first) && (!is_above || (second < third && third <= count)));
    if (age > 5) assert (group == own);
    if (divided && rounds == 0) begin
      assert (\dut.g_divide[0].divide_one.n == at && \dut.g_divide[0].divide_one.d == cluster);
      assert (\dut.g_divide[1].divide_one.n == place && \dut.g_divide[1].divide_one.d == unit);
    end
    if (divided && rounds == 1) begin
      assert (balanced && \dut.g_divide[1].divide_one.n == own_begin && \dut.g_divide[1].divide_one.d == groups);
      assert (!is_below || (\dut.g_divide[0].divide_one.n == own_begin - unit && \dut.g_divide[0].divide_one.d == groups));
      assert (\dut.g_divide[2].divide_one.n == own_begin + unit && \dut.g_divide[2].divide_one.d == groups);
      assert (!is_above || (\dut.g_divide[3].divide_one.n == own_begin + 2 * unit && \dut.g_divide[3].divide_one.d == groups));
    end
    if (over) begin
      assert (parent == above && group == own && reference_at == own_reference);
      assert (next_group == (up ? own + 11'd1 : down ? own - 11'd1 : own));
      assert (next_reference_at == (up ? 10'(second + ((third - second - 11'd1) >> 1)) : down ? 10'(before + ((first - before - 11'd1) >> 1)) : own_reference));
      cover (balanced && up);
      cover (!balanced && down);
    end
  end
endmodule
