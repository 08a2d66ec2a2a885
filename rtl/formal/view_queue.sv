// A step of the queue from any state: a descriptor passes FETCH, CHECK, RUN, FLUSH, STATUS and FINISH, and counts when it ends; its place in both
// rings; commands and what ends them; errors are counted, the first kept; the result; events; reset.
//
// Clauses: Status, Registers (docs/view_unit.md)
// Engine: bmc 3
// Complete: any step; counts of requests in flight are those that the unit around it gives.
// Cover: 2
// Fault: hmlfc_view_queue.sv / if (block_error && block_errors == 0) / if (block_error)
// Fault: hmlfc_view_queue.sv / write_failed && state != FINISH / write_failed
// Fault: hmlfc_view_queue.sv / state == RUN && !placed / state == RUN
// Fault: hmlfc_view_queue.sv / counted && ring_empty / finished && ring_empty
// Fault: hmlfc_view_queue.sv / {status_address[5:4], 4'd0} / {status_address[4], 4'd0}
module prove_view_queue (
  input logic clk, input logic rst_n, input logic enable, input logic disable_queue, input logic drain, input logic abort_view,
  input logic [15:0] producer, input logic fetched, input logic [31:0] tag, input logic refused, input logic fetch_failed, input logic request_waits,
  input logic asked, input logic answered, input logic placed, input logic block_error, input logic [5:0] error, input logic written,
  input logic write_failed, input logic line_ready);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  localparam integer IDLE = 0, FETCH = 1, CHECK = 2, RUN = 3, FLUSH = 4, STATUS = 5, FINISH = 6;
  (* anyconst *) logic [A-7:0] ring;
  (* anyconst *) logic [A-5:0] statuses;
  (* anyconst *) logic [3:0] log;  // of the size of the rings
  logic [15:0]  consumer;
  logic [5:0]   status;
  logic [3:0]   events;
  logic         busy, fetch_start, view_start, ask, flush, line_valid;
  logic [A-1:0] fetch_address;
  logic [A-7:0] line;
  logic [511:0] line_data;
  logic [63:0]  line_strobe;
  hmlfc_view_queue dut (
    .clk(clk), .rst_n(rst_n), .enable(enable), .disable_queue(disable_queue), .drain(drain), .abort_view(abort_view), .ring_base({ring, 6'd0}),
    .status_base({statuses, 4'd0}), .ring_size(16'd1 << log), .producer(producer), .consumer(consumer), .status(status), .events(events),
    .busy(busy), .fetch_start(fetch_start), .fetch_address(fetch_address), .fetched(fetched), .tag(tag), .refused(refused),
    .fetch_failed(fetch_failed), .view_start(view_start), .ask(ask), .request_waits(request_waits), .asked(asked), .answered(answered),
    .placed(placed), .block_error(block_error), .error(error), .flush(flush), .written(written), .write_failed(write_failed),
    .line_valid(line_valid), .line_ready(line_ready), .line(line), .line_data(line_data), .line_strobe(line_strobe));
  (* hierconn *) wire [2:0]  \dut.state ;
  (* hierconn *) wire        \dut.asks_no_more ;
  (* hierconn *) wire [15:0] \dut.in_flight ;
  wire [2:0] state = \dut.state ;

  // What the status says, and the words of it.
  wire enabled = status[0], running = status[1], draining = status[2], aborting = status[3], empty = status[4], lost = status[5];
  wire [31:0] writes = line_data[127:96], blocks = line_data[95:64];
  wire [7:0]  first = line_data[47:40], result = line_data[39:32];

  wire [15:0]  place = 16'({16'd0, consumer} << (16 - log)) >> (16 - log);
  wire [A-1:0] status_place = {statuses, 4'd0} + {20'd0, place, 4'd0};
  wire finished = state == FINISH && written;
  wire stops = aborting ? !running || finished || (draining && empty && !running) : draining && empty && !running;
  wire gives_up = \dut.asks_no_more && \dut.in_flight == 0 && !asked;
  logic [2:0] next;
  always @* begin
    next = state;
    case (state)
      IDLE: if (enabled && !aborting && !empty) next = FETCH;
      FETCH: if (fetched) next = CHECK;
      CHECK: next = aborting || refused || fetch_failed ? STATUS : RUN;
      RUN: if (placed || gives_up) next = FLUSH;
      FLUSH: if (written) next = STATUS;
      STATUS: if (line_ready) next = FINISH;
      default: if (written) next = IDLE;
    endcase
  end

  logic        was = 1'b0;
  logic        was_reset, was_stops, was_finished, was_idle;
  logic [2:0]  after;
  logic [3:0]  flags;  // lost, aborting, draining, enabled
  logic [15:0] count, flying;
  logic [31:0] more_writes, more_blocks;
  logic [7:0]  kept;
  logic        aborted, no_more;
  always @(posedge clk) begin
    was <= 1'b1;
    {was_reset, was_stops, was_finished, was_idle} <= {!rst_n, stops, finished, state == IDLE};
    after <= rst_n ? next : 3'd0;
    flags <= rst_n ? {lost || (state == FINISH && write_failed), (aborting || abort_view) && !stops, (draining || drain) && !stops,
                      (enabled || enable) && !disable_queue && !stops} : 4'd0;
    count <= rst_n ? consumer + 16'(finished) : 16'd0;
    more_writes <= state == IDLE ? 0 : writes + 32'(write_failed && state != FINISH);
    more_blocks <= state == IDLE ? 0 : blocks + 32'(block_error);
    kept <= state == IDLE ? 8'd0 : block_error && blocks == 0 ? {2'd0, error} : first;
    aborted <= state != IDLE && (result == 4 || (aborting && (state == CHECK || (state == RUN && !placed))));
    no_more <= rst_n && state == RUN && (\dut.asks_no_more || (aborting && !request_waits));
    flying <= rst_n && state == RUN ? \dut.in_flight + 16'(asked) - 16'(answered) : 16'd0;
  end
  always @* begin
    assume (state <= FINISH);
    assert (running == (state != IDLE) && empty == (producer == consumer));
    assert (fetch_start == (state == IDLE && next == FETCH) && view_start == (state == CHECK && next == RUN));
    assert (ask == (state == RUN && !\dut.asks_no_more ) && flush == (state == FLUSH) && line_valid == (state == STATUS));
    if (fetch_start) assert (fetch_address == {ring, 6'd0} + {18'd0, place, 6'd0});
    if (line_valid) begin
      assert (line_data[127:0] == line_data[255:128] && line_data[127:0] == line_data[383:256] && line_data[127:0] == line_data[511:384]);
      assert (line_data[31:0] == tag && first < 64);
      assert (line == status_place >> 6);
      for (integer i = 0; i < 4; i = i + 1) assert (line_strobe[16*i +: 16] == (status_place[5:4] == i ? 16'hffff : 16'd0));
      if (result != 4) assert (result == (fetch_failed || writes != 0 ? 3 : refused ? 2 : blocks != 0 ? 1 : 0));
    end
    assert (events[0] == finished && events[1] == ((finished && result != 0) || (state == FINISH && write_failed)));
    if (was) begin
      assert (state == after && {lost, aborting, draining, enabled} == flags && consumer == count);
      assert (writes == more_writes && blocks == more_blocks && first == kept && (result == 4) == aborted);
      assert (\dut.asks_no_more == no_more && \dut.in_flight == flying);
      assert (events[3] == (was_stops && !was_reset) && events[2] == (was_finished && !was_reset && empty));
      assert (busy == (running || fetch_start || stops || (!was_reset && (was_stops || was_finished))));
    end
    cover (was && line_valid && result == 3);
    cover (was && events[2] && events[3]);
  end
endmodule
