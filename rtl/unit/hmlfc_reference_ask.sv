// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Works out where a block's references are displaced to (MOT-7 to MOT-9) and asks the caches for their windows.
//
// K0 comes through cache A, K1 to K3 through cache B; both windows of reference set 5 come through B, the first one
// first. A block of a key image asks A for its own samples. With one cache it is B, for all. Blocks with an error ask
// for none. Latency 7 clocks, or with one unit for both vectors 4 times 2.
module hmlfc_reference_ask #(
    parameter int BLOCK_LOG2 = 2,
    parameter int RESIDUAL_BITS = 160,
    parameter int CACHES = 2,  // 1, 2
    parameter int UNITS = 2,  // for vectors: 1, which takes 2 clocks for a block, or 2
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SLOT_BITS = 1 + ADDRESS_BITS + 2 + 11 + 15 + 15 + 17 + 17 + 2
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input hmlfc_pkg::image_references_t image,  // of in_flow.job.id
    input hmlfc_pkg::flow_t in_flow,

    input logic in_valid,
    output logic in_ready,
    input logic in_has_residual,
    input logic [RESIDUAL_BITS-1:0] in_residual,

    // To each cache: {section, address, plane, strips_x, width, height, x, y, extra_x, extra_y}.
    output logic a_valid,
    input logic a_ready,
    output logic [SLOT_BITS-1:0] a_window,
    output logic b_valid,
    input logic b_ready,
    output logic [SLOT_BITS-1:0] b_window,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::pending_t out_pending,
    output logic [RESIDUAL_BITS-1:0] out_residual
);

  // MOT-7: numbers of the references of a set.
  wire [2:0] set = in_flow.motion.reference_set;
  wire two = set == 3'd1 || set == 3'd2 || set == 3'd5 || set == 3'd6;
  logic [1:0] k_first, k_second;
  always_comb begin
    k_first = 2'd0;
    k_second = 2'd0;
    unique case (set)
      3'd1: k_second = 2'd1;
      3'd2: k_second = 2'd2;
      3'd3: k_first = 2'd1;
      3'd4: k_first = 2'd2;
      3'd5: {k_first, k_second} = {2'd1, 2'd2};
      3'd6: k_second = 2'd3;
      3'd7: k_first = 2'd3;
      default: ;
    endcase
  end

  wire chroma = in_flow.job.plane != 2'd0;
  wire key = image.keyed && image.is_reference;
  wire motion = in_flow.motion.used && !key && in_flow.job.error == 0;
  // The plane's offset in a reference image.
  wire [ADDRESS_BITS-1:0] offset = in_flow.job.plane == 2'd0 ? ADDRESS_BITS'(0) :
      in_flow.job.plane == 2'd1 ? ADDRESS_BITS'(stream.luma_bytes) :
          ADDRESS_BITS'(stream.luma_bytes) + ADDRESS_BITS'(stream.chroma_bytes);

  // Stage 1: what K0 to K3 are. At powers of two a selection takes no multiplier.
  wire [4*64-1:0] addresses = {
    64'(image.address_3), 64'(image.address_2), 64'(image.address_1), 64'(image.address_0)
  };
  wire [4*32-1:0] steps = {
    4'd0, image.cols_3, image.rows_3, 4'd0, image.cols_2, image.rows_2, 4'd0, image.cols_1, image.rows_1,
    4'd0, image.cols_0, image.rows_0
  };
  wire [1:0] k_own = motion ? k_first : 2'd0;  // a key image's own samples are those of K0

  localparam int CARRY_BITS = hmlfc_pkg::JOB_BITS + 5 + 1 + RESIDUAL_BITS;
  localparam int STAGES = UNITS == 2 ? 7 : 4;
  logic advance, turn;
  wire last_turn = UNITS == 2 || turn;
  wire step = !last_turn || advance;
  logic [STAGES:1] valid;
  logic [27:0] steps_a, steps_b;
  logic [12:0] disparity;
  logic explicit_mode, halve;
  logic [11:0] explicit_x, explicit_y;
  logic [STAGES*CARRY_BITS-1:0] carries;
  logic [ADDRESS_BITS-1:0] base_a, base_b, offset_1;
  logic [(STAGES-1)*2*ADDRESS_BITS-1:0] planes;  // addresses of the planes, from stage 2 on

  always_ff @(posedge clk) begin
    if (advance) begin
      steps_a <= steps[32'(k_first)*32+:28];
      steps_b <= steps[32'(k_second)*32+:28];
      disparity <= in_flow.motion.choice == 4'd10 ? 13'($signed(in_flow.motion.explicit_x)) : in_flow.disparity;
      explicit_mode <= in_flow.motion.choice == 4'd11 || !motion;
      explicit_x <= motion ? in_flow.motion.explicit_x : 12'd0;
      explicit_y <= motion ? in_flow.motion.explicit_y : 12'd0;
      halve <= chroma && !stream.chroma_444 && stream.features.motion_tiles && !stream.features.chroma_motion;
      carries <= {
        carries[(STAGES-1)*CARRY_BITS-1:0],
        in_flow.job, key && in_flow.job.error == 0, motion && image.keyed, motion, motion && in_flow.motion.negative,
        motion && two, in_has_residual, in_residual
      };
      base_a <= addresses[32'(k_own)*64+:ADDRESS_BITS];
      base_b <= addresses[32'(k_second)*64+:ADDRESS_BITS];
      offset_1 <= offset;
      planes <= {planes[(STAGES-2)*2*ADDRESS_BITS-1:0], base_a + offset_1, base_b + offset_1};
      valid <= {valid[STAGES-1:1], in_valid};
    end
    if (!rst_n) valid <= '0;
  end
  assign in_ready = advance;
  // Which cache the first reference takes goes with its number; K2 and K3 use the second section of B.
  logic [STAGES:1] first_from_b, section_a, section_b;
  always_ff @(posedge clk) begin
    if (advance) begin
      first_from_b <= {first_from_b[STAGES-1:1], CACHES == 1 || (motion && k_first != 2'd0)};
      section_a <= {section_a[STAGES-1:1], k_first[1]};
      section_b <= {section_b[STAGES-1:1], k_second[1]};
    end
  end

  // From stage 2 on: vectors, {fy, fx, iy, ix} of the first and the second. With one unit the first comes a clock
  // before the second, and is kept.
  localparam int VECTOR_BITS = 24;
  logic [8:0] ix_a, iy_a, ix_b, iy_b;
  logic [2:0] fx_a, fy_a, fx_b, fy_b;
  logic [UNITS*VECTOR_BITS-1:0] vectors;
  logic [VECTOR_BITS-1:0] first_vector;
  for (genvar u = 0; u < UNITS; u++) begin : g_vector
    wire [27:0] coefficients = (UNITS == 2 ? u == 1 : turn) ? steps_b : steps_a;
    hmlfc_vector vector (
        .clk, .advance(step), .disparity, .coefficient_x(coefficients[27:18]), .coefficient_y(coefficients[17:0]),
        .vector_precision(stream.vector_precision), .disparity_precision(stream.disparity_precision),
        .window(stream.window), .explicit_mode, .explicit_x, .explicit_y, .halve, .ix(vectors[u*VECTOR_BITS+:9]),
        .iy(vectors[u*VECTOR_BITS+9+:9]), .fx(vectors[u*VECTOR_BITS+18+:3]), .fy(vectors[u*VECTOR_BITS+21+:3])
    );
  end
  if (UNITS == 2) begin : g_together
    assign first_vector = vectors[VECTOR_BITS-1:0];
  end else begin : g_in_turn
    always_ff @(posedge clk) if (!turn) first_vector <= vectors;
  end
  assign {fy_a, fx_a, iy_a, ix_a} = first_vector;
  assign {fy_b, fx_b, iy_b, ix_b} = vectors[UNITS*VECTOR_BITS-1-:VECTOR_BITS];

  // What comes out: the block is given on when both caches have taken their windows.
  hmlfc_pkg::job_t job;
  logic key_out, base_zero_out, motion_out, negative_out, two_out, has_residual_out;
  logic [ADDRESS_BITS-1:0] address_a, address_b;
  assign {job, key_out, base_zero_out, motion_out, negative_out, two_out, has_residual_out, out_residual} =
      carries[(STAGES-1)*CARRY_BITS+:CARRY_BITS];
  assign {address_a, address_b} = planes[(STAGES-2)*2*ADDRESS_BITS+:2*ADDRESS_BITS];
  always_comb begin
    out_pending.job = job;
    out_pending.key = key_out;
    out_pending.base_zero = base_zero_out;
    out_pending.motion = motion_out;
    out_pending.negative = negative_out;
    out_pending.two = two_out;
    out_pending.first_from_b = first_from_b[STAGES];
    out_pending.has_residual = has_residual_out;
    {out_pending.ix_a, out_pending.iy_a, out_pending.fx_a, out_pending.fy_a} = {ix_a, iy_a, fx_a, fy_a};
    {out_pending.ix_b, out_pending.iy_b, out_pending.fx_b, out_pending.fy_b} = {ix_b, iy_b, fx_b, fy_b};
  end

  hmlfc_pkg::plane_t plane;
  assign plane = job.plane == 2'd0 ? stream.luma : stream.chroma;
  wire signed [16:0] x = $signed(17'(job.bx) << BLOCK_LOG2);
  wire signed [16:0] y = $signed(17'(job.by) << BLOCK_LOG2);
  wire [SLOT_BITS-1:0] window_a = {
    section_a[STAGES], address_a, job.plane, plane.strips_x, plane.width, plane.height,
    x + 17'($signed(ix_a)), y + 17'($signed(iy_a)), fx_a != 0, fy_a != 0
  };
  wire [SLOT_BITS-1:0] window_b = {
    section_b[STAGES], address_b, job.plane, plane.strips_x, plane.width, plane.height,
    x + 17'($signed(ix_b)), y + 17'($signed(iy_b)), fx_b != 0, fy_b != 0
  };

  // Windows to request: first and second, each once.
  logic first_taken, second_taken;
  wire first_needed = key_out || motion_out;
  wire first_done = !first_needed || first_taken;
  wire second_done = !two_out || second_taken;
  wire ready = valid[STAGES] && last_turn;
  assign a_valid = ready && !first_done && !first_from_b[STAGES];
  assign a_window = window_a;
  assign b_valid = ready && (first_from_b[STAGES] && !first_done || !second_done);
  assign b_window = first_from_b[STAGES] && !first_done ? window_a : window_b;
  wire a_takes = a_valid && a_ready;
  wire b_takes = b_valid && b_ready;
  wire first_now = first_done || a_takes || (b_takes && first_from_b[STAGES]);
  wire second_now = second_done || (b_takes && !(first_from_b[STAGES] && !first_done));
  assign out_valid = ready && first_now && second_now;
  assign advance = last_turn && (!valid[STAGES] || (out_valid && out_ready));
  always_ff @(posedge clk) begin
    if (!rst_n || advance) begin
      first_taken <= 1'b0;
      second_taken <= 1'b0;
    end else if (ready) begin
      if (first_needed) first_taken <= first_now;
      if (two_out) second_taken <= second_now;
    end
    turn <= rst_n && !(last_turn && advance);
  end

endmodule

`default_nettype wire
