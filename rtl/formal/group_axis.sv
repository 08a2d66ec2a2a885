// Groups of one row or column of images, from any state, step by step: divisions for the parent and the group, then for the begins of the groups around
// it, then the reference images in the middle of them, and the neighbour of MOT-7 with its own.
//
// Clauses: STR-3, STR-4, EXT-3, MOT-7
// Engine: bmc 2
// Complete: any state and one step from it; the four divisions go together and may give anything (proof divide).
// Fault: hmlfc_group_axis.sv / 22'(groups) - 22'd1 / 22'(groups)
// Fault: hmlfc_group_axis.sv / at >= middles[11+:10] / at > middles[11+:10]
// Fault: hmlfc_group_axis.sv / > 22'(count) ? count : / > 22'(count) ? count - 11'd1 :
// Fault: hmlfc_group_axis.sv / up ? middles[22+:10] / up ? middles[11+:10]
// Fault: hmlfc_group_axis.sv / group == 0; / 1'b0;
// Fault: hmlfc_group_axis.sv / (22'(unit) << 1) / 22'(unit)

// In the place of a division.
module hmlfc_divide #(parameter integer WIDTH = 22, parameter integer DIVISOR_BITS = 11, parameter integer QUOTIENT_BITS = 11) (
  input logic clk, input logic rst_n, input logic start, input logic [WIDTH-1:0] dividend, input logic [DIVISOR_BITS-1:0] divisor,
  output logic idle, output logic done, output logic [QUOTIENT_BITS-1:0] quotient
);
  (* anyseq *) logic [QUOTIENT_BITS+1:0] any;
  wire [WIDTH+DIVISOR_BITS+1:0] given = {rst_n, start, dividend, divisor};
  assign {idle, done, quotient} = any;
endmodule

module prove_group_axis (
  input logic clk, input logic start, input logic [9:0] at, input logic [10:0] count, input logic [7:0] size, input logic [10:0] groups,
  input logic balanced, input logic [7:0] cluster
);
  logic        done;
  logic [10:0] group, next_group;
  logic [9:0]  reference_at, next_reference_at, parent;
  hmlfc_group_axis dut (
    .clk(clk), .rst_n(1'b1), .start(start), .at(at), .count(count), .size(size), .groups(groups), .balanced(balanced), .cluster(cluster),
    .done(done), .group(group), .reference_at(reference_at), .next_group(next_group), .next_reference_at(next_reference_at), .parent(parent));
  (* hierconn *) wire [12:0] \dut.g_divide[0].divide_one.any ;
  (* hierconn *) wire [12:0] \dut.g_divide[1].divide_one.any ;
  (* hierconn *) wire [12:0] \dut.g_divide[2].divide_one.any ;
  (* hierconn *) wire [12:0] \dut.g_divide[3].divide_one.any ;
  (* hierconn *) wire [34:0] \dut.g_divide[0].divide_one.given ;
  (* hierconn *) wire [34:0] \dut.g_divide[1].divide_one.given ;
  (* hierconn *) wire [34:0] \dut.g_divide[2].divide_one.given ;
  (* hierconn *) wire [34:0] \dut.g_divide[3].divide_one.given ;
  (* hierconn *) wire [2:0] \dut.state ;
  (* hierconn *) wire \dut.started ;
  (* hierconn *) wire [21:0] \dut.product ;
  (* hierconn *) wire [43:0] \dut.firsts ;
  localparam logic [2:0] IDLE = 0, PLACE = 1, PRODUCT = 2, BEGINS = 3, MIDDLES = 4;
  wire [2:0]  state = \dut.state ;
  wire        free = \dut.g_divide[0].divide_one.any [12];
  wire        divided = \dut.g_divide[0].divide_one.any [11];
  wire [10:0] quotient_0 = \dut.g_divide[0].divide_one.any [10:0];
  wire [10:0] quotient_1 = \dut.g_divide[1].divide_one.any [10:0];
  wire [10:0] quotient_2 = \dut.g_divide[2].divide_one.any [10:0];
  wire [10:0] quotient_3 = \dut.g_divide[3].divide_one.any [10:0];
  wire [32:0] asked_0 = \dut.g_divide[0].divide_one.given [32:0];
  wire [32:0] asked_1 = \dut.g_divide[1].divide_one.given [32:0];
  wire [32:0] asked_2 = \dut.g_divide[2].divide_one.given [32:0];
  wire [32:0] asked_3 = \dut.g_divide[3].divide_one.given [32:0];

  // Row k of groups begins at k * unit, with balanced groups a groups-th of that: of the image's group, and of those around it.
  wire [10:0] unit = balanced ? count : 11'(size);
  wire [21:0] place = balanced ? (22'(at) + 22'd1) * 22'(groups) - 22'd1 : 22'(at);
  wire [21:0] own = \dut.product , before = own - 22'(unit), after = own + 22'(unit), second = own + (22'(unit) << 1);
  function automatic [10:0] within(input [21:0] begins, input [10:0] end_of_grid);
    within = begins < 22'(end_of_grid) ? begins[10:0] : end_of_grid;
  endfunction
  // The middle of a group that begins at `first` and ends before `end_of`.
  function automatic [10:0] middle(input [10:0] first, input [10:0] end_of);
    reg [10:0] rows;
    rows = end_of - first;
    middle = first + ((rows - 11'd1) >> 1);
  endfunction
  wire [10:0] first_before = \dut.firsts [10:0], first = \dut.firsts [21:11], first_after = \dut.firsts [32:22], first_second = \dut.firsts [43:33];
  wire [9:0]  own_middle = 10'(middle(first, first_after));
  wire        is_after = group + 11'd1 < groups, is_before = group != 0;
  wire        up = at >= own_middle ? is_after : !is_before && is_after;
  wire        down = !up && is_before;
  wire        asks = ((state == PLACE) || (state == BEGINS && balanced)) && !\dut.started ;

  function automatic ordered(input [10:0] b0, input [10:0] b1, input [10:0] b2, input [10:0] b3);
    ordered = b1 <= at && at < b2 && b2 <= count && (!is_before || b0 < b1) && (!is_after || (b2 < b3 && b3 <= count));
  endfunction
  logic        was = 1'b0;
  logic [2:0]  next_state;
  logic        next_started, next_done;
  logic [9:0]  next_parent, next_own, next_other;
  logic [10:0] next_own_group, next_other_group;
  logic [21:0] next_product;
  logic [43:0] next_firsts;
  always @(posedge clk) begin
    was <= 1'b1;
    next_state <= start ? PLACE : state == PLACE && divided ? PRODUCT : state == PRODUCT ? BEGINS : state == BEGINS && (divided || !balanced) ? MIDDLES :
                  state == MIDDLES ? IDLE : state;
    next_started <= !start && state != PRODUCT && (\dut.started || (asks && free));
    next_done <= state == MIDDLES;
    {next_own_group, next_parent} <= state == PLACE && divided ? {quotient_1, quotient_0[9:0]} : {group, parent};
    next_product <= state == PRODUCT ? 22'(group) * 22'(unit) : \dut.product ;
    next_firsts <= \dut.firsts ;
    if (state == BEGINS && balanced && divided) next_firsts <= {quotient_3, quotient_2, quotient_1, quotient_0};
    if (state == BEGINS && !balanced) next_firsts <= {within(second, count), within(after, count), within(own, count), within(before, count)};
    {next_own, next_other_group, next_other} <= {reference_at, next_group, next_reference_at};
    if (state == MIDDLES) begin
      next_own <= own_middle;
      next_other_group <= up ? group + 11'd1 : down ? group - 11'd1 : group;
      next_other <= 10'(up ? middle(first_after, first_second) : down ? middle(first_before, first) : 11'(own_middle));
    end
  end
  always @* begin
    // What groups of a grid are; a group holds the image.
    assume (count >= 1 && count <= 1024 && at < count && size != 0 && cluster != 0 && groups >= 1 && groups <= count);
    if (!was) assume (state <= MIDDLES);
    if (!was && state > PLACE) assume (group < groups && parent <= at);
    if (!was && state == BEGINS) assume (own <= place && place < after && (!is_before || own >= 22'(unit)));
    if (!was && state == BEGINS && !balanced) assume (is_after == (after < 22'(count)));
    if (!was && state == BEGINS && divided) assume (ordered(quotient_0, quotient_1, quotient_2, quotient_3));
    if (!was && state == MIDDLES) assume (ordered(first_before, first, first_after, first_second));
    if (!was && state == PLACE && divided) assume (quotient_1 < groups && quotient_0 <= at);
    assume (\dut.g_divide[1].divide_one.any [12:11] == {free, divided} && \dut.g_divide[2].divide_one.any [12:11] == {free, divided});
    assume (\dut.g_divide[3].divide_one.any [12:11] == {free, divided});
    assert (\dut.g_divide[0].divide_one.given [34:33] == {1'b1, asks && free} && \dut.g_divide[1].divide_one.given [34:33] == {1'b1, asks && free});
    assert (\dut.g_divide[2].divide_one.given [34:33] == {1'b1, asks && free} && \dut.g_divide[3].divide_one.given [34:33] == {1'b1, asks && free});
    if (asks && state == PLACE) assert (asked_0 == {22'(at), 11'(cluster)} && asked_1 == {place, unit});
    if (asks && state == BEGINS) assert (asked_0 == {before, groups} && asked_1 == {own, groups} && asked_2 == {after, groups} && asked_3 == {second, groups});
    if (was) begin
      assert ({state, \dut.started , done, group, parent} == {next_state, next_started, next_done, next_own_group, next_parent});
      assert (\dut.product == next_product);
      assert (\dut.firsts == next_firsts);
      assert ({reference_at, next_group, next_reference_at} == {next_own, next_other_group, next_other});
    end
  end
endmodule
