// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reference groups of one row or column of a level's images (STR-3, STR-4, EXT-3, MOT-7).
//
// `start` takes a place among `count` images, in reference groups of `size`; 12 clocks later, or 19 with `balanced`,
// `done` is high for one clock when the results are valid: its group and that group's reference image, the neighbouring
// group of MOT-7 on the side of `at` and its reference image's place, and the place of the parent in the next level.
// They hold until the next start.
//
// Two rounds of divisions, each beside each other: parent and group, then the begins of the groups around it, of which
// the neighbour's need not be known before.
module hmlfc_group_axis (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [9:0] at,
    input logic [10:0] count,
    input logic [7:0] size,
    input logic [10:0] groups,
    input logic balanced,
    input logic [7:0] cluster,
    output logic done,
    output logic [10:0] group,
    output logic [9:0] reference_at,
    output logic [10:0] next_group,
    output logic [9:0] next_reference_at,
    output logic [9:0] parent
);

  typedef enum logic [2:0] {
    IDLE,
    PLACE,    // parent and group
    PRODUCT,
    BEGINS,
    MIDDLES
  } state_t;
  state_t state;

  // Begins of groups group - 1 to group + 2, times `groups` where they are balanced. Those of groups that are not there
  // are any number, and not used.
  wire [10:0] unit = balanced ? count : 11'(size);
  logic [21:0] product;  // group * unit
  wire [4*22-1:0] begins = {
    product + (22'(unit) << 1), product + 22'(unit), product, product - 22'(unit)
  };

  logic started;
  logic [3:0] idle, divided;
  logic [4*11-1:0] quotients;
  logic [3:0] unused;  // bits of quotients, which are 0
  wire [4*22-1:0] dividends = state == BEGINS ? begins : {
    44'd0, balanced ? (22'(at) + 22'd1) * 22'(groups) - 22'd1 : 22'(at), 22'(at)
  };
  wire [4*11-1:0] divisors = state == BEGINS ? {4{groups}} : {22'd0, balanced ? count : 11'(size), 11'(cluster)};
  wire divide = (state == PLACE || (state == BEGINS && balanced)) && !started;
  for (genvar i = 0; i < 4; i++) begin : g_divide
    hmlfc_divide #(.WIDTH(22), .DIVISOR_BITS(11), .QUOTIENT_BITS(12), .STEP(2)) divide_one (
        .clk, .rst_n, .start(divide && idle == 4'hF), .dividend(dividends[i*22+:22]), .divisor(divisors[i*11+:11]),
        .idle(idle[i]), .done(divided[i]), .quotient({unused[i], quotients[i*11+:11]})
    );
  end

  // The begins, then the reference images in the middle of groups group - 1 to group + 1.
  logic [4*11-1:0] firsts;
  logic [3*11-1:0] middles;
  always_comb begin
    for (int i = 0; i < 3; i++) begin
      middles[i*11+:11] = firsts[i*11+:11] + ((firsts[(i+1)*11+:11] - firsts[i*11+:11] - 11'd1) >> 1);
    end
  end
  wire up = at >= middles[11+:10] ? group + 11'd1 < groups : group == 0;

  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (divide && idle == 4'hF) started <= 1'b1;
    unique case (state)
      PLACE:
      if (divided[0]) begin
        parent <= quotients[9:0];
        group <= quotients[21:11];
        state <= PRODUCT;
      end
      PRODUCT: begin
        product <= 22'(group) * 22'(unit);
        started <= 1'b0;
        state <= BEGINS;
      end
      BEGINS:
      if (!balanced || divided[0]) begin
        for (int i = 0; i < 4; i++) begin
          firsts[i*11+:11] <= balanced ? quotients[i*11+:11] :
              begins[i*22+:22] > 22'(count) ? count : begins[i*22+:11];
        end
        state <= MIDDLES;
      end
      MIDDLES: begin
        reference_at <= middles[11+:10];
        next_group <= groups == 11'd1 ? group : up ? group + 11'd1 : group - 11'd1;
        next_reference_at <= groups == 11'd1 ? middles[11+:10] : up ? middles[22+:10] : middles[9:0];
        done <= 1'b1;
        state <= IDLE;
      end
      default: ;  // IDLE
    endcase
    if (start) begin
      state <= PLACE;
      started <= 1'b0;
    end
    if (!rst_n) begin
      state <= IDLE;
      started <= 1'b0;
      done <= 1'b0;
    end
  end

endmodule

`default_nettype wire
