/// A stand-in for your decoder, to try hmlfc_checker.sv on: takes up to DEPTH requests, and answers each
/// after a random number of clocks with what the golden model says. Shows the samples of a block at
/// level 0. +fault=NAME plants a fault in answer number +fault_at=N (default 5):
///
///   sample  one sample of one lane     status  another status        swap   two answers change places
///   missing the answer is left out     extra   it comes twice        stage  one value of a stage
///   unknown one bit of a sample is x   bus     bus_error             status_x  the status is unknown
module stand_in_decoder #(
    parameter int BLOCK_LOG2 = 2,
    parameter int DEPTH = 8,    // requests in flight
    parameter int LATENCY = 20, // greatest number of clocks from one answer to the next
    parameter bit TAGGED = 0,   // 1: answers come in any order, with the tags of their requests
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,

    input logic request_valid,
    output logic request_ready,
    input logic [11:0] request_row,
    input logic [11:0] request_col,
    input logic [1:0] request_plane,
    input logic [14:0] request_block_x,
    input logic [14:0] request_block_y,
    input logic [3:0] request_stop_level,
    input logic [15:0] request_tag,

    output logic answer_valid,
    input logic answer_ready,
    output logic [15:0] answer_tag,
    output logic [5:0] answer_status,
    output logic [3*SAMPLES*16-1:0] answer_samples,

    output logic stage_valid,
    output logic [11:0] stage_row,
    output logic [11:0] stage_col,
    output logic [1:0] stage_plane,
    output logic [14:0] stage_block_x,
    output logic [14:0] stage_block_y,
    output logic [SAMPLES*16-1:0] stage_sample
);

  import "DPI-C" function int hmlfc_checker_open(input string stream, input string device, input int block_log2);
  import "DPI-C" function int hmlfc_checker_expected(input int id, input int row, input int col, input int plane,
      input int block_x, input int block_y, input int stop_level, output logic [3071:0] samples);
  // The variables of this behavioural model, which no other process reads.
  /* verilator lint_off BLKSEQ */
  /* verilator lint_off UNUSEDSIGNAL */  // blocks of 8 fill `samples`

  // Requests in flight, the oldest first: tag, stop level, y, x, plane, column, row.
  logic [75:0] waiting[DEPTH];
  int count, model, delay, answers, fault_at;
  string fault, stream_file, device_file;
  logic [3071:0] samples;
  bit twice;  // the answer comes once more

  initial begin
    if ($value$plusargs("fault=%s", fault) == 0) fault = "none";
    if ($value$plusargs("fault_at=%d", fault_at) == 0) fault_at = 5;
    if ($value$plusargs("hmlfc_checker_stream=%s", stream_file) == 0) stream_file = "";
    if ($value$plusargs("hmlfc_checker_device=%s", device_file) == 0) device_file = "";
    model = hmlfc_checker_open(stream_file, device_file, BLOCK_LOG2);  // 0 ends hmlfc_checker too
  end

  // Whether the fault `name` is due.
  function automatic bit faulty(input string name);
    faulty = fault == name && answers == fault_at;
  endfunction

  task automatic take_request;
    waiting[count] = {request_tag, request_stop_level, request_block_y, request_block_x, request_plane, request_col, request_row};
    count = count + 1;
  endtask

  // Takes request `number` out of `waiting` and shows its answer.
  task automatic give_answer(input int number);
    logic [75:0] r;
    int status;
    r = waiting[number];
    for (int i = number; i < DEPTH - 1; i++) waiting[i] = waiting[i+1];
    count = count - 1;
    status = hmlfc_checker_expected(model, 32'(r[11:0]), 32'(r[23:12]), 32'(r[25:24]), 32'(r[40:26]), 32'(r[55:41]),
        32'(r[59:56]), samples);
    {stage_block_y, stage_block_x, stage_plane, stage_col, stage_row} <= r[55:0];
    stage_valid <= status == 0 && r[25:24] != 3 && r[59:56] == 0;
    stage_sample <= (SAMPLES * 16)'(samples) ^ (SAMPLES * 16)'(faulty("stage"));
    if (faulty("sample")) samples[SAMPLES*16+32+:16] = samples[SAMPLES*16+32+:16] + 1;
    if (faulty("unknown")) samples[33] = 1'bx;
    answer_valid <= !faulty("missing");
    answer_tag <= r[75:60];
    answer_status <= faulty("status") ? 6'd24 : faulty("bus") ? 6'd27 : faulty("status_x") ? 6'bx : 6'(status);
    answer_samples <= (3 * SAMPLES * 16)'(samples);
    twice = faulty("extra");
    answers = answers + 1;
  endtask

  // What is done while no answer waits.
  task automatic next_answer;
    if (delay > 0) delay = delay - 1;
    else if (count > (faulty("swap") ? 1 : 0)) begin
      give_answer(TAGGED ? int'($urandom % 32'(count)) : faulty("swap") ? 1 : 0);
      delay = int'($urandom % 32'(LATENCY));
    end
  endtask

  task automatic run_clock;
    stage_valid <= 0;
    if (!rst_n) begin
      count = 0;
      delay = 0;
      answers = 0;
      twice = 0;
      answer_valid <= 0;
    end else begin
      if (request_valid && request_ready) take_request();
      if (!answer_valid) next_answer();
      else if (answer_ready) begin
        answer_valid <= twice;
        twice = 0;
      end
    end
    request_ready <= rst_n && count < DEPTH;
  endtask

  always @(posedge clk) run_clock();

endmodule
