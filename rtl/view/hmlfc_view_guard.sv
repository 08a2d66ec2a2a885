// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Resets the view unit on software's command without harm to its buses, and says when the memory does not answer.
//
// From `reset_unit` on `resetting` is high: the decode unit's registers take no other access, and as soon as none is
// under way `unit_rst_n` is low, until all that was asked of the memory has come or been written; it is dropped.
// `hung`: for `watchdog` clocks, if that is not 0, the memory owed an answer and no channel to it moved (`moves`).
module hmlfc_view_guard (
    input logic clk,
    input logic rst_n,

    input logic reset_unit,
    input logic accessed,  // an access to the decode unit's registers is under way
    output logic resetting,
    output logic unit_rst_n,

    input logic read_asked,
    input logic read_ended,
    input logic writes_idle,
    input logic moves,
    input logic [23:0] watchdog,
    output logic hung
);

  logic [7:0] reads;  // bursts without their last beat
  logic [23:0] clocks;
  logic stands;  // the unit is in reset
  wire waits = reads != 0 || !writes_idle;
  assign unit_rst_n = rst_n && !stands;
  assign hung = watchdog != 0 && clocks == watchdog;
  always_ff @(posedge clk) begin
    if (!rst_n) begin
      reads <= '0;
      clocks <= '0;
      resetting <= 1'b0;
      stands <= 1'b0;
    end else begin
      reads <= reads + 8'(read_asked) - 8'(read_ended && reads != 0);
      if (!waits || moves || watchdog == 0) clocks <= '0;
      else if (!hung) clocks <= clocks + 24'd1;
      resetting <= reset_unit || (resetting && (!stands || waits));
      stands <= resetting && (stands ? waits : !accessed);
    end
  end

endmodule

`default_nettype wire
