/// The golden model in lock-step with a decoder of .hmlfc streams (docs/checker.md): watches the
/// requests that the device takes, its answers and, if it shows them, the stages of its blocks. The
/// first difference ends the simulation with a message; the end of the simulation prints statistics.
///
///   +hmlfc_checker_stream=FILE    the stream that the device decodes
///   +hmlfc_checker_device=FILE    its capability file
///   +hmlfc_checker_continue       count differences, and go on
///   +hmlfc_checker_wave=FILE +hmlfc_checker_first=N +hmlfc_checker_last=N
///                                 dump the wave of these clocks, then end: the message names them
///
/// Everything is sampled at the rising edge of clk. A request may be answered in the clock in which it
/// is taken. A stage record belongs to a request that was taken and is not answered yet, and comes in
/// the clock of the answer at the latest.
module hmlfc_checker #(
    parameter int BLOCK_LOG2 = 2,  // 1..3: blocks of 2, 4 or 8
    parameter bit OPTIONAL = 0,    // 1: without +hmlfc_checker_stream nothing is checked, nor is that an error
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,  // 0: the device forgets its requests

    input logic request_valid,
    input logic request_ready,
    input logic [11:0] request_row,
    input logic [11:0] request_col,
    input logic [1:0] request_plane,  // 0 Y, 1 Co, 2 Cg, 3 RGB
    input logic [14:0] request_block_x,
    input logic [14:0] request_block_y,
    input logic [3:0] request_stop_level,
    input logic [15:0] request_tag,  // 0 where answers come in order

    input logic answer_valid,
    input logic answer_ready,
    input logic [15:0] answer_tag,
    input logic [5:0] answer_status,
    input logic [3*SAMPLES*16-1:0] answer_samples,  // lanes Y, Co or Cg; or R, G, B; 16 bits a sample, lowest first

    input logic stage_valid,  // 0 where the device shows no stages
    input logic [3:0] stage_level,
    input logic [11:0] stage_row,  // of the image in the level's grid
    input logic [11:0] stage_col,
    input logic [1:0] stage_plane,
    input logic [14:0] stage_block_x,
    input logic [14:0] stage_block_y,
    input logic [5:0] stage_error,
    input logic [3:0] stage_shown,  // the block has: bit 0 a residual, 1 a reference, 2 a prediction, 3 samples
    input logic [SAMPLES*16-1:0] stage_residual,
    input logic [SAMPLES*16-1:0] stage_reference,  // R of MOT-9
    input logic [SAMPLES*16-1:0] stage_prediction,  // A of DEC-3
    input logic [SAMPLES*16-1:0] stage_sample
);

  import "DPI-C" function int hmlfc_checker_open(input string stream, input string device, input int block_log2);
  import "DPI-C" function string hmlfc_checker_text(input int id);
  import "DPI-C" function int hmlfc_checker_request(input int id, input longint clocks, input int row, input int col,
      input int plane, input int block_x, input int block_y, input int stop_level, input int tag);
  import "DPI-C" function int hmlfc_checker_answer(input int id, input longint clocks, input int tag, input int status,
      input logic [3071:0] samples);
  import "DPI-C" function int hmlfc_checker_stage(input int id, input longint clocks, input int row, input int col,
      input int plane, input int block_x, input int block_y, input int level, input int error, input int shown,
      input logic [4095:0] values);
  import "DPI-C" function int hmlfc_checker_unknown(input int id, input longint clocks, input string where);
  import "DPI-C" function void hmlfc_checker_reset(input int id, input longint clocks);
  import "DPI-C" function int hmlfc_checker_end(input int id, input longint clocks, input int complete);
  int id;  // of the checker behind the interface; 0: nothing is checked
  longint clocks;  // rising edges so far
  longint wave_first, wave_last;
  bit go_on, waves;
  string stream_file, device_file, wave_file, scope;

  // Prints a difference; the first one ends the simulation.
  function automatic void on_differences(input int count);
    if (count != 0) begin
      $write("%s", hmlfc_checker_text(id));
      $display("  in         %s at time %0t", scope, $time);
      // Nested: Verilator 5.006 calls functions of the right side of && in any case.
      if (!go_on && !waves) begin
        if (hmlfc_checker_end(id, clocks, 0) != 0) begin
          $write("%s", hmlfc_checker_text(id));
          $fatal(1, "hmlfc_checker: not equal to the golden model");
        end
      end
    end
  endfunction

  initial begin
    id = 0;
    clocks = 0;
    $sformat(scope, "%m");
    go_on = $test$plusargs("hmlfc_checker_continue") != 0;
    waves = $value$plusargs("hmlfc_checker_wave=%s", wave_file) != 0;
    if ($value$plusargs("hmlfc_checker_first=%d", wave_first) == 0) wave_first = 0;
    if ($value$plusargs("hmlfc_checker_last=%d", wave_last) == 0) wave_last = 64'h7fff_ffff_ffff_ffff;
    if ($value$plusargs("hmlfc_checker_stream=%s", stream_file) == 0) stream_file = "";
    if ($value$plusargs("hmlfc_checker_device=%s", device_file) == 0) device_file = "";
    if (waves) $dumpfile(wave_file);  // here: beside $dumpvars, version 5.006 of Verilator swaps them
    if (!OPTIONAL || stream_file != "") begin
      id = hmlfc_checker_open(stream_file, device_file, BLOCK_LOG2);
      $write("%s", hmlfc_checker_text(id));
      if (id == 0) $fatal(1, "hmlfc_checker: nothing can be checked");
    end
  end

  // What is not a value decides nothing: x and z at the pins of handshakes and places are differences.
  logic unknown_request, unknown_answer, unknown_stage;
  assign unknown_request = ^request_valid === 1'bx || (request_valid && ^{request_ready, request_row, request_col,
      request_plane, request_block_x, request_block_y, request_stop_level, request_tag} === 1'bx);
  assign unknown_answer = ^answer_valid === 1'bx || (answer_valid && ^{answer_ready, answer_tag, answer_status} === 1'bx);
  assign unknown_stage = ^stage_valid === 1'bx || (stage_valid && ^{stage_level, stage_row, stage_col, stage_plane,
      stage_block_x, stage_block_y, stage_error, stage_shown} === 1'bx);

  always @(posedge clk) begin
    clocks <= clocks + 1;
    if (id != 0) check();
  end

  // One clock.
  task automatic check;
    if (waves && clocks == wave_first) $dumpvars;
    if (rst_n !== 1'b1) begin
      hmlfc_checker_reset(id, clocks);
    end else begin
      if (unknown_request) on_differences(hmlfc_checker_unknown(id, clocks, "request"));
      if (unknown_answer) on_differences(hmlfc_checker_unknown(id, clocks, "answer"));
      if (unknown_stage) on_differences(hmlfc_checker_unknown(id, clocks, "stage"));
      if (request_valid && request_ready)
        on_differences(hmlfc_checker_request(id, clocks, 32'(request_row), 32'(request_col), 32'(request_plane),
            32'(request_block_x), 32'(request_block_y), 32'(request_stop_level), 32'(request_tag)));
      if (stage_valid)
        on_differences(hmlfc_checker_stage(id, clocks, 32'(stage_row), 32'(stage_col), 32'(stage_plane),
            32'(stage_block_x), 32'(stage_block_y), 32'(stage_level), 32'(stage_error), 32'(stage_shown),
            {1024'(stage_sample), 1024'(stage_prediction), 1024'(stage_reference), 1024'(stage_residual)}));
      if (answer_valid && answer_ready)
        on_differences(hmlfc_checker_answer(id, clocks, 32'(answer_tag), 32'(answer_status),
            3072'(answer_samples)));
    end
    if (waves && clocks == wave_last) $finish;
  endtask

  final begin
    if (id != 0) begin
      if (hmlfc_checker_end(id, clocks, waves ? 0 : 1) == 0) begin
        $write("%s", hmlfc_checker_text(id));
      end else begin
        $write("%s", hmlfc_checker_text(id));
        $fatal(1, "hmlfc_checker: not equal to the golden model");
      end
    end
  end

endmodule
