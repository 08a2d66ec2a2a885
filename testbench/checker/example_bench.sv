/// A bench with hmlfc_checker.sv in it: asks the stand-in for view +row=R +col=C in RGB, for a quarter of
/// its blocks in plane Co, then of plane Y at level 1, and for a block that does not exist. The size of the
/// view in blocks of plane Y is +blocks_x=N +blocks_y=N.
module example_bench #(
    parameter int BLOCK_LOG2 = 2,
    parameter bit TAGGED = 0
);
  localparam int SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam int PATIENCE = 1000;  // clocks without an answer until the bench ends

  logic clk = 0;
  logic rst_n = 0;

  logic request_valid = 0;
  logic request_ready;
  logic [11:0] request_row, request_col;
  logic [1:0] request_plane;
  logic [14:0] request_block_x, request_block_y;
  logic [3:0] request_stop_level;
  logic [15:0] request_tag;
  logic answer_valid, answer_ready;
  logic [15:0] answer_tag;
  logic [5:0] answer_status;
  logic [3*SAMPLES*16-1:0] answer_samples;
  logic stage_valid;
  logic [11:0] stage_row, stage_col;
  logic [1:0] stage_plane;
  logic [14:0] stage_block_x, stage_block_y;
  logic [SAMPLES*16-1:0] stage_sample;

  stand_in_decoder #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .TAGGED(TAGGED)
  ) decoder (.*);

  hmlfc_checker #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) model_check (
      .*,
      .stage_level(4'd0),
      .stage_error(6'd0),
      .stage_shown(4'b1000),
      .stage_residual({(SAMPLES * 16) {1'b0}}),
      .stage_reference({(SAMPLES * 16) {1'b0}}),
      .stage_prediction({(SAMPLES * 16) {1'b0}})
  );

  int blocks_x, blocks_y, idle;
  logic [1:0] turn;

  initial begin
    if ($value$plusargs("row=%d", request_row) == 0) request_row = 0;
    if ($value$plusargs("col=%d", request_col) == 0) request_col = 0;
    if ($value$plusargs("blocks_x=%d", blocks_x) == 0) blocks_x = 4;
    if ($value$plusargs("blocks_y=%d", blocks_y) == 0) blocks_y = 4;
    forever #5 clk = !clk;
  end

  // The next block of the view; after the last one the next turn.
  task automatic next_block;
    int shift;
    shift = turn == 0 ? 0 : 1;
    request_block_x <= request_block_x + 1;
    if (32'(request_block_x) + 1 >= blocks_x >> shift) begin
      request_block_x <= 0;
      request_block_y <= request_block_y + 1;
      if (32'(request_block_y) + 1 >= blocks_y >> shift) begin
        request_block_y <= 0;
        turn <= turn + 1;
        if (turn == 2) request_block_x <= 15'h7fff;  // no such block
      end
    end
    if (turn == 3) request_valid <= 0;
  endtask

  // Turn 0: RGB; 1: Co; 2: Y of level 1; 3: the end.
  assign request_plane = turn == 0 ? 2'd3 : turn == 1 ? 2'd1 : 2'd0;
  assign request_stop_level = turn == 2 ? 4'd1 : 4'd0;

  task automatic run_clock;
    answer_ready <= $urandom % 4 != 0;
    if (!rst_n) begin
      rst_n <= idle == 4;
      {request_block_x, request_block_y, turn, request_tag} <= 0;
      request_valid <= idle == 4;
    end else if (request_valid && request_ready) begin
      next_block();
      request_tag <= request_tag + 1;
    end
    idle <= answer_valid || request_valid ? 0 : idle + 1;
    if (idle == PATIENCE) $finish;
  endtask

  always @(posedge clk) run_clock();
endmodule
