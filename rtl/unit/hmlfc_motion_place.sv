// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The place (X, Y) of block (bx, by) in its motion plane (MOT-4), in samples; bx, by in [0, 2^14 / B - 1].
module hmlfc_motion_place #(
    parameter int BLOCK_LOG2 = 2
) (
    input hmlfc_pkg::config_t stream,
    input logic [1:0] plane,
    input logic [hmlfc_pkg::BLOCK_BITS-1:0] bx,
    input logic [hmlfc_pkg::BLOCK_BITS-1:0] by,
    output logic [14:0] x,
    output logic [14:0] y
);
  wire doubled = plane != 2'd0 && !stream.chroma_444 && !stream.features.chroma_motion;
  always_comb begin
    x = 15'(bx) << BLOCK_LOG2;
    y = 15'(by) << BLOCK_LOG2;
    if (doubled) begin
      x = x << 1;
      y = y << 1;
    end
  end
endmodule

`default_nettype wire
